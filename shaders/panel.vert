// A flat picture in the world: a tile of the wall as a visitor sees it. In: one of four corners by
// its number.
uniform mat4 clip_from_world;
uniform vec3 lower_left_in_world;
uniform vec3 right_edge;
uniform vec3 up_edge;
uniform vec2 uv_low;
uniform vec2 uv_high;
layout(location = 0) out vec2 uv;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  uv = mix(uv_low, uv_high, corner);
  gl_Position =
      clip_from_world * vec4(lower_left_in_world + corner.x * right_edge + corner.y * up_edge, 1.0);
}

// Geometry of a scene. In: vertices in node. Out: position and normal in world, clip position.
// The world position is computed first and alone, so that it is bit-equal on all tiles.

layout(location = 0) in vec3 position_in_node;
layout(location = 1) in vec3 normal_in_node;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;

layout(std140, binding = 0) uniform Node {
  mat4 world_from_node;
  mat4 normal_from_node;
};
uniform mat4 clip_from_world;

layout(location = 0) out vec3 out_position_in_world;
layout(location = 1) out vec3 out_normal_in_world;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec4 out_colour;

void main() {
  vec4 position_in_world = vec4((world_from_node * vec4(position_in_node, 1.0)).xyz, 1.0);
  out_position_in_world = position_in_world.xyz;
  out_normal_in_world = mat3(normal_from_node) * normal_in_node;
  out_uv = uv;
  out_colour = colour;
  gl_Position = clip_from_world * position_in_world;
}

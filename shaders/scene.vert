// Geometry of a scene, for its picture and for its shadow. In: vertices in node. Out: position,
// normal and tangent in world, clip position. The world position is computed first and alone, so
// that it is bit-equal on all tiles.

layout(location = 0) in vec3 position_in_node;
layout(location = 1) in vec3 normal_in_node;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
#ifdef NORMAL_TEXTURE
layout(location = 4) in vec4 tangent_in_node;  // w: the bitangent's sign
#endif
#ifdef SECOND_UV
layout(location = 5) in vec2 uv_1;
#endif

layout(std140, binding = 0) uniform Node {
  mat4 world_from_node;
  mat4 normal_from_node;
  vec4 handedness;  // -1: the node is mirrored
};
uniform mat4 clip_from_world;

layout(location = 0) out vec3 out_position_in_world;
layout(location = 1) out vec3 out_normal_in_world;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec4 out_colour;
#ifdef NORMAL_TEXTURE
layout(location = 4) out vec4 out_tangent_in_world;
#endif
#ifdef SECOND_UV
layout(location = 5) out vec2 out_uv_1;
#endif

void main() {
  vec4 position_in_world = vec4((world_from_node * vec4(position_in_node, 1.0)).xyz, 1.0);
  out_position_in_world = position_in_world.xyz;
  out_normal_in_world = mat3(normal_from_node) * normal_in_node;
  out_uv = uv;
  out_colour = colour;
#ifdef NORMAL_TEXTURE
  out_tangent_in_world =
      vec4(mat3(world_from_node) * tangent_in_node.xyz, handedness.x * tangent_in_node.w);
#endif
#ifdef SECOND_UV
  out_uv_1 = uv_1;
#endif
  gl_Position = clip_from_world * position_in_world;
}

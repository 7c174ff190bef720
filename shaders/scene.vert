// Geometry of a scene, for its picture and for its shadow. In: vertices in node, or where they are
// SKINNED in their mesh's own frame. Out: position, normal and tangent in world, clip position. The
// world position is computed first and alone, so that it is bit-equal on all tiles.

layout(location = 0) in vec3 position_in_node;
layout(location = 1) in vec2 packed_normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
#ifdef NORMAL_TEXTURE
layout(location = 4) in vec3 packed_tangent;  // z: the bitangent's sign, of 32767
#endif
#ifdef SECOND_UV
layout(location = 5) in vec2 uv_1;
#endif
#ifdef SKINNED
layout(location = 6) in uvec4 joints;
layout(location = 7) in vec4 weights;  // 1 together

layout(binding = 6) uniform samplerBuffer world_from_mesh_rows;  // three of each joint
#else
layout(std140, binding = 0) uniform Node {
  mat4 world_from_node;
  mat4 normal_from_node;
  vec4 handedness;  // -1: the node is mirrored
};
#endif
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

#ifdef SKINNED
mat3x4 rows_of(uint joint) {
  int first = 3 * int(joint);
  return mat3x4(texelFetch(world_from_mesh_rows, first),
                texelFetch(world_from_mesh_rows, first + 1),
                texelFetch(world_from_mesh_rows, first + 2));
}

// The joints' matrices, blended by weight.
mat4x3 world_from_mesh() {
  return transpose(weights.x * rows_of(joints.x) + weights.y * rows_of(joints.y) +
                   weights.z * rows_of(joints.z) + weights.w * rows_of(joints.w));
}
#endif

// As renderer/packed_scene.h packs them.
vec3 direction(vec2 square) {
  vec3 folded = vec3(square, 1.0 - abs(square.x) - abs(square.y));
  float over = max(-folded.z, 0.0);
  folded.x += folded.x < 0.0 ? over : -over;
  folded.y += folded.y < 0.0 ? over : -over;
  return normalize(folded);
}

void main() {
  vec3 normal_in_node = direction(packed_normal);
#ifdef SKINNED
  mat4x3 world_from_node = world_from_mesh();
  vec4 position_in_world = vec4(world_from_node * vec4(position_in_node, 1.0), 1.0);
  // Normals turn with the inverse transpose, which is the cofactors over the determinant. Its size
  // differs from vertex to vertex, and must not weigh when they are interpolated.
  vec3 x = world_from_node[0], y = world_from_node[1], z = world_from_node[2];
  float side = dot(cross(x, y), z) < 0.0 ? -1.0 : 1.0;
  vec3 normal = side * (mat3(cross(y, z), cross(z, x), cross(x, y)) * normal_in_node);
  float size = length(normal);
  out_normal_in_world = size > 0.0 ? normal / size : normal_in_node;
#else
  float side = handedness.x;
  vec4 position_in_world = vec4((world_from_node * vec4(position_in_node, 1.0)).xyz, 1.0);
  out_normal_in_world = mat3(normal_from_node) * normal_in_node;
#endif
  out_position_in_world = position_in_world.xyz;
  out_uv = uv;
  out_colour = colour;
#ifdef NORMAL_TEXTURE
  out_tangent_in_world =
      vec4(mat3(world_from_node) * direction(packed_tangent.xy), side * sign(packed_tangent.z));
#endif
#ifdef SECOND_UV
  out_uv_1 = uv_1;
#endif
  gl_Position = clip_from_world * position_in_world;
}

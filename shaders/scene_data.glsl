// What renderer/gpu_scene.cpp uploads (std430).
struct Node {
  mat4 world_from_node;
  mat4 normal_from_node;
};
struct Material {
  vec4 base_colour;             // linear
  vec4 emissive_metallic;       // rgb, metallic
  vec4 roughness_cutoff_unlit;  // roughness, alpha cutoff (negative: none), unlit, has a texture
};
layout(std430, binding = 0) readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 1) readonly buffer Materials { Material materials[]; };

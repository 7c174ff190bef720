// A draw's material, as renderer/gpu_scene.cpp writes it.
layout(std140, binding = 1) uniform Material {
  vec4 base_colour;        // light
  vec4 emissive_metallic;  // rgb, metallic
  vec4 roughness_cutoff;   // roughness, alpha cutoff (negative: none)
  vec4 srgb;               // vertex colours are sRGB
}
material;

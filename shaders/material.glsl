// A surface's material and textures, and where its base colour has holes. A macro X_TEXTURE says
// that there is a texture X, SECOND_UV that one of them uses the second coordinates.

// As renderer/gpu_scene.cpp writes it.
layout(std140, binding = 1) uniform Material {
  vec4 base_colour;                        // light
  vec4 emissive_metallic;                  // rgb, metallic
  vec4 roughness_cutoff_normal_occlusion;  // alpha cutoff (negative: none), scale, strength
  vec4 texture_from_uv[10];                // two rows for each texture; w: which coordinates
}
material;

layout(binding = 0) uniform sampler2D base_colour_texture;
layout(binding = 1) uniform sampler2D metallic_roughness_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(binding = 3) uniform sampler2D occlusion_texture;
layout(binding = 4) uniform sampler2D emissive_texture;

layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
#ifdef SECOND_UV
layout(location = 5) in vec2 uv_1;
#endif

vec2 uv_of(int unit) {
  vec4 u = material.texture_from_uv[2 * unit], v = material.texture_from_uv[2 * unit + 1];
#ifdef SECOND_UV
  vec3 from = vec3(u.w > 0.5 ? uv_1 : uv, 1.0);
#else
  vec3 from = vec3(uv, 1.0);
#endif
  return vec2(dot(u.xyz, from), dot(v.xyz, from));
}

vec4 base_colour() {
  vec4 base = material.base_colour * colour;
#if defined(BASE_COLOUR_TEXTURE) && defined(MEASURE)
  base *= textureLod(base_colour_texture, uv_of(0), 0.0);
#elif defined(BASE_COLOUR_TEXTURE)
  base *= texture(base_colour_texture, uv_of(0));
#endif
  return base;
}

#ifdef MASKED
// Leaves out what the mask cuts away, sample by sample: alpha is steepened to rise from 0 to 1
// within a pixel around the cutoff (B. Golus, "Anti-aliased Alpha Test: The Esoteric Alpha To
// Coverage", 2017); the smaller the mask is seen, the less, until alpha is the share that it
// covers. The samples are chosen here, since what alpha to coverage does differs between GPUs.
void cut_out(float alpha) {
  float cutoff = material.roughness_cutoff_normal_occlusion.y;
#ifdef MEASURE
  if (alpha < cutoff) discard;
#else
  float lod = 0.0;
#ifdef BASE_COLOUR_TEXTURE
  lod = max(0.0, textureQueryLod(base_colour_texture, uv_of(0)).x);
#endif
  if (gl_NumSamples == 1) alpha *= 1.0 + 0.25 * lod;  // or it would thin out to nothing
  float width = max(fwidth(alpha), clamp(0.3 * lod - 0.3, 1e-4, 1.0));
  int covered = int(clamp((alpha - cutoff) / width + 0.5, 0.0, 1.0) * float(gl_NumSamples) + 0.5);
  if (covered == 0) discard;
  gl_SampleMask[0] = (1 << covered) - 1;
#endif
}
#endif

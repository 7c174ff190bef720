// Surfaces. In: world position and normal, material. Out: linear light after the tone curve (the
// framebuffer encodes sRGB); with UNLIT the base colour alone; with MEASURE its bytes as they are,
// by a shader that takes no derivatives. With TEXTURED the base colour is times a texture.
#include "environment.glsl"

// The material, as renderer/gpu_scene.cpp writes it.
layout(std140, binding = 1) uniform Material {
  vec4 base_colour;        // light
  vec4 emissive_metallic;  // rgb, metallic
  vec4 roughness_cutoff;   // roughness, alpha cutoff (negative: none)
}
material;

layout(location = 0) in vec3 position_in_world;
layout(location = 1) in vec3 normal_in_world;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;

layout(binding = 0) uniform sampler2D base_colour_texture;
uniform vec3 eye_in_world;

layout(location = 0) out vec4 out_colour;

const float kPi = 3.14159265;

// GGX with height-correlated Smith visibility (Heitz 2014) and Schlick's Fresnel; light along
// `to_light`.
vec3 key_light(vec3 n, vec3 v, vec3 albedo, vec3 f0, float roughness, vec3 to_light, vec3 light) {
  vec3 h = normalize(v + to_light);
  float n_l = max(dot(n, to_light), 0.0), n_v = max(dot(n, v), 1e-3);
  float n_h = max(dot(n, h), 0.0), v_h = max(dot(v, h), 0.0);
  float a2 = max(pow(roughness, 4.0), 1e-4);
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float distribution = a2 / (kPi * d * d);
  float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) +
                            n_v * sqrt(n_l * n_l * (1.0 - a2) + a2) + 1e-5);
  vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - v_h, 5.0);
  return n_l * light * (albedo * (1.0 - fresnel) + kPi * distribution * visibility * fresnel);
}

// Environment light: diffuse from the normal's hemisphere, specular from the mirrored direction,
// with the analytic fit of the split-sum's second term (B. Karis, "Physically Based Shading on
// Mobile", 2014).
vec3 environment_light(vec3 n, vec3 v, vec3 albedo, vec3 f0, float roughness) {
  float n_v = max(dot(n, v), 1e-3);
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a004 = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a004 + r.zw;
  vec3 specular = environment(reflect(-v, n), roughness) * (f0 * scale_bias.x + scale_bias.y);
  return albedo * environment(n, 1.0) + specular;
}

void main() {
  vec4 base = material.base_colour * colour;
#if defined(TEXTURED) && defined(MEASURE)
  base *= textureLod(base_colour_texture, uv, 0.0);
#elif defined(TEXTURED)
  base *= texture(base_colour_texture, uv);
#endif
  if (base.a < material.roughness_cutoff.y) discard;
#if defined(MEASURE) || defined(UNLIT)
  out_colour = base;
#else
  vec3 v = normalize(eye_in_world - position_in_world);
  // The normal on the viewer's side of the face: old files mix the winding of their triangles.
  vec3 n = normalize(normal_in_world);
  vec3 face = cross(dFdx(position_in_world), dFdy(position_in_world));
  if (dot(face, v) * dot(face, n) < 0.0) n = -n;
  float metallic = material.emissive_metallic.a, roughness = material.roughness_cutoff.x;
  vec3 albedo = base.rgb * (1.0 - metallic);
  vec3 f0 = mix(vec3(0.04), base.rgb, metallic);
  vec3 light = environment_light(n, v, albedo, f0, roughness);
  light += key_light(n, v, albedo, f0, roughness, kToKey, kKeyLight);
  light += key_light(n, v, albedo, f0, roughness, kToRim, kRimLight);
  out_colour = vec4(tone(light + material.emissive_metallic.rgb), base.a);
#endif
}

// Surfaces. In: world position, normal and tangent, material. Out: linear light after the tone
// curve (the framebuffer encodes sRGB); with UNLIT the base colour alone; with MEASURE its bytes as
// they are, by a shader that takes no derivatives. The other macros are those of material.glsl and
// shadow.glsl.
#include "material.glsl"
#include "environment.glsl"
#include "surface.glsl"
#include "shadow.glsl"

layout(location = 0) in vec3 position_in_world;
layout(location = 1) in vec3 normal_in_world;
#ifdef NORMAL_TEXTURE
layout(location = 4) in vec4 tangent_in_world;
#endif

uniform vec3 eye_in_world;
uniform vec3 to_key;

layout(location = 0) out vec4 out_colour;

#if !defined(MEASURE) && !defined(UNLIT)
Surface surface(vec4 base) {
  vec4 factors = material.roughness_cutoff_normal_occlusion;
  Surface s;
  s.to_viewer = normalize(eye_in_world - position_in_world);
  s.face_normal = normalize(normal_in_world);
  s.normal = s.face_normal;
#ifdef NORMAL_TEXTURE
  vec3 mapped = texture(normal_texture, uv_of(2)).xyz * 2.0 - 1.0;
  vec3 tangent = tangent_in_world.xyz - s.normal * dot(s.normal, tangent_in_world.xyz);
  tangent = normalize(tangent + 1e-12);
  vec3 bitangent = cross(s.normal, tangent) * tangent_in_world.w;
  s.normal = normalize(mat3(tangent, bitangent, s.normal) * (mapped * vec3(factors.zz, 1.0)));
#endif
  // Normals on the viewer's side of the face: its back has them too, and old files mix the winding
  // of their triangles. One that clearly looks at the viewer stays: the face of a triangle that is
  // thinner than a pixel is known badly.
  vec3 face = cross(dFdx(position_in_world), dFdy(position_in_world));
  bool away = dot(face, s.to_viewer) * dot(face, s.face_normal) < 0.0;
  if (away && dot(s.face_normal, s.to_viewer) < 0.3) {
    s.normal = -s.normal;
    s.face_normal = -s.face_normal;
  }
  float metallic = material.emissive_metallic.a;
  s.roughness = factors.x;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  vec2 rough_metal = texture(metallic_roughness_texture, uv_of(1)).gb;
  s.roughness *= rough_metal.x;
  metallic *= rough_metal.y;
#endif
  s.albedo = base.rgb * (1.0 - metallic);
  s.f0 = mix(vec3(0.04), base.rgb, metallic);
  s.occlusion = 1.0;
#ifdef OCCLUSION_TEXTURE
  s.occlusion = mix(1.0, texture(occlusion_texture, uv_of(3)).r, factors.w);
#endif
  return s;
}

vec3 emitted() {
  vec3 light = material.emissive_metallic.rgb;
#ifdef EMISSIVE_TEXTURE
  light *= texture(emissive_texture, uv_of(4)).rgb;
#endif
  return light;
}
#endif

void main() {
  vec4 base = base_colour();
#ifdef MASKED
  cut_out(base.a);
#endif
#if defined(MEASURE) || defined(UNLIT)
  out_colour = base;
#else
  Surface s = surface(base);
  float alpha_ggx = ggx_alpha(s);
  vec3 light = environment_light(s, alpha_ggx) + emitted();
  vec3 key = direct_light(s, alpha_ggx, to_key) * kKeyLight;
#ifdef SHADOWED
  key *= key_visibility(position_in_world, s.face_normal, to_key, eye_in_world);
#endif
  out_colour = vec4(tone(light + key), base.a);
#endif
}

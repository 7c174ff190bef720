// How a surface answers light: glTF 2.0's metallic-roughness (appendix B) with GGX, and the
// environment of environment.glsl by split sum (B. Karis, "Real Shading in Unreal Engine 4", 2013).
struct Surface {
  vec3 to_viewer;
  vec3 face_normal;  // interpolated, on the viewer's side
  vec3 normal;       // with the normal map
  vec3 albedo;
  vec3 f0;
  float roughness;
  float occlusion;
};

// GGX's alpha, wider where normals turn within a pixel, or highlights would shimmer (Y. Tokuyoshi
// and A. Kaplanyan, "Improved Geometric Specular Antialiasing", 2019). Never a mirror: the key
// light has a size.
float ggx_alpha(Surface s) {
  vec3 across = dFdx(s.normal), along = dFdy(s.normal);
  float variance = 0.25 * (dot(across, across) + dot(along, along));
  float alpha = s.roughness * s.roughness;
  return sqrt(clamp(alpha * alpha + min(2.0 * variance, 0.18), 1e-3, 1.0));
}

// Height-correlated Smith visibility (E. Heitz, 2014), Schlick's Fresnel; times pi, so that a light
// of 1 makes white white.
vec3 direct_light(Surface s, float alpha, vec3 to_light) {
  vec3 n = s.normal, v = s.to_viewer;
  vec3 h = normalize(v + to_light);
  float n_l = max(dot(n, to_light), 0.0), n_v = max(dot(n, v), 1e-3);
  float n_h = max(dot(n, h), 0.0), v_h = max(dot(v, h), 0.0);
  float a2 = alpha * alpha;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float distribution = a2 / (d * d);
  float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) +
                            n_v * sqrt(n_l * n_l * (1.0 - a2) + a2) + 1e-5);
  float m = 1.0 - v_h, m2 = m * m;
  vec3 fresnel = s.f0 + (1.0 - s.f0) * (m2 * m2 * m);
  return n_l * (s.albedo * (1.0 - fresnel) + distribution * visibility * fresnel);
}

// The split sum's second term is Karis' analytic fit ("Physically Based Shading on Mobile", 2014);
// light that bounces several times within a rough surface is made up for (C. Fdez-Agüera, "A
// Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting", 2019).
vec3 environment_light(Surface s, float alpha) {
  float n_v = max(dot(s.normal, s.to_viewer), 1e-3);
  float roughness = sqrt(alpha);
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a004 = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a004 + r.zw;
  vec3 once = s.f0 * scale_bias.x + scale_bias.y;
  vec3 often = 1.0 + s.f0 * (1.0 / (scale_bias.x + scale_bias.y) - 1.0);
  vec3 mirrored = reflect(-s.to_viewer, s.normal);
  // A rough lobe leans towards the normal.
  vec3 specular = radiance(normalize(mix(mirrored, s.normal, 0.7 * alpha * alpha)), alpha);
#ifdef NORMAL_TEXTURE
  float above = clamp(1.0 + dot(mirrored, s.face_normal), 0.0, 1.0);
  specular *= above * above;  // not from below the face
#endif
  vec3 diffuse = s.albedo * (1.0 - once) * irradiance(s.normal);
  return s.occlusion * (diffuse + specular * once * often);
}

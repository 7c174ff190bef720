// The light around the scene, the same for surfaces, reflections and the background: a gradient
// from a dark floor over a pale horizon to a blue zenith, one warm key light from the upper left
// before the wall, one cool rim light from behind. Directions in world (+y up, +z towards the
// viewer); radiance linear, 1 is white.
const vec3 kToKey = normalize(vec3(-0.45, 0.75, 0.55));
const vec3 kKeyLight = vec3(1.05, 0.97, 0.86);
const vec3 kToRim = normalize(vec3(0.6, 0.35, -0.75));
const vec3 kRimLight = vec3(0.22, 0.29, 0.40);

const vec3 kZenith = vec3(0.24, 0.30, 0.41);
const vec3 kHorizon = vec3(0.40, 0.40, 0.40);
const vec3 kGround = vec3(0.11, 0.10, 0.095);

// Wider steps for rough surfaces, which gather from half the sphere.
vec3 environment(vec3 direction, float roughness) {
  float y = normalize(direction).y;
  float width = mix(0.12, 1.0, roughness);
  vec3 sky = mix(kHorizon, kZenith, smoothstep(0.0, 1.0, y));
  return mix(kGround, sky, smoothstep(-width, width, y));
}

// Khronos PBR Neutral tone mapper (Khronos Group, 2024): base colours stay what they are,
// highlights compress.
vec3 tone(vec3 light) {
  const float start = 0.8 - 0.04, desaturation = 0.15;
  float lowest = min(light.r, min(light.g, light.b));
  float offset = lowest < 0.08 ? lowest - 6.25 * lowest * lowest : 0.04;
  light -= offset;
  float peak = max(light.r, max(light.g, light.b));
  if (peak < start) return light;
  float range = 1.0 - start;
  float compressed = 1.0 - range * range / (peak + range - start);
  light *= compressed / peak;
  float grey = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
  return mix(light, vec3(compressed), grey);
}

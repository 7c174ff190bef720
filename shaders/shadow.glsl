// How much of the key light reaches a point: 0 in its shadow, 1 outside. SHADOWED: there is a map;
// SOFT_SHADOWS: edges are spread over three of its texels.
#ifdef SHADOWED
layout(binding = 5) uniform sampler2DShadow shadow_map;
uniform mat4 map_from_world;
uniform float shadow_texel_m;
// How far picture and map may be off each other where they show other levels of detail: the map,
// and the picture for each metre from the eye.
uniform vec2 level_error_m;

float key_visibility(vec3 position_in_world, vec3 normal, vec3 to_light, vec3 eye_in_world) {
  // Off the surface, the farther the flatter the light falls, or it would shadow itself
  // (D. Holbert, "Saying Goodbye to Shadow Acne", 2011).
  float cosine = clamp(dot(normal, to_light), 0.0, 1.0);
#ifdef SOFT_SHADOWS
  const float reach_px = 2.5;
#else
  const float reach_px = 1.5;
#endif
  float off_m = reach_px * shadow_texel_m * sqrt(1.0 - cosine * cosine) + 0.1 * shadow_texel_m;
  off_m += dot(level_error_m, vec2(1.0, distance(eye_in_world, position_in_world)));
  vec3 place = (map_from_world * vec4(position_in_world + off_m * normal, 1.0)).xyz;
  place.z = min(place.z + 1e-5, 1.0);
#ifdef SOFT_SHADOWS
  // A tent over 3 x 3 texels as four bilinear comparisons at its quarters' middles of weight.
  vec2 size = vec2(textureSize(shadow_map, 0));
  vec2 step_uv = 0.75 / size;
  float lit = texture(shadow_map, place + vec3(-step_uv.x, -step_uv.y, 0.0)) +
              texture(shadow_map, place + vec3(step_uv.x, -step_uv.y, 0.0)) +
              texture(shadow_map, place + vec3(-step_uv.x, step_uv.y, 0.0)) +
              texture(shadow_map, place + vec3(step_uv.x, step_uv.y, 0.0));
  lit *= 0.25;
#else
  float lit = texture(shadow_map, place);
#endif
  // Outside the map nothing is in the shadow.
  vec2 inside = step(abs(place.xy - 0.5), vec2(0.5));
  return place.z < 0.0 ? 1.0 : mix(1.0, lit, inside.x * inside.y);
}
#endif

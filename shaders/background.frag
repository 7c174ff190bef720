// What is behind everything: a studio backdrop by direction, calmer than the light that the scene
// gets.

layout(location = 0) in vec2 ndc;
uniform mat3 direction_from_ndc;  // in world
layout(location = 0) out vec4 out_colour;

void main() {
  vec3 direction = normalize(direction_from_ndc * vec3(ndc, 1.0));
  float y = direction.y;
  vec3 sky = mix(vec3(0.105, 0.125, 0.150), vec3(0.020, 0.028, 0.045), smoothstep(0.0, 0.8, y));
  vec3 floor_colour =
      mix(vec3(0.060, 0.062, 0.068), vec3(0.015, 0.015, 0.018), smoothstep(0.0, 0.7, -y));
  out_colour = vec4(mix(floor_colour, sky, smoothstep(-0.02, 0.02, y)), 1.0);
}

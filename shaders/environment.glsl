// The light around the scene, a photographer's studio that is made here: a gradient from a dark
// floor over a pale horizon to a blue zenith, four soft boxes, and the key light, which alone
// throws shadows. It is the same for all surfaces of all tiles. Formulas take the place of an
// environment map: reflections stay sharp, and nothing is to be loaded.
// Directions in world (+y up, +z towards the viewer); radiance linear, 1 is white.
const vec3 kKeyLight = vec3(0.80, 0.74, 0.66);

const vec3 kZenith = vec3(0.110, 0.148, 0.220);
const vec3 kHorizon = vec3(0.250, 0.255, 0.265);
const vec3 kGround = vec3(0.105, 0.098, 0.090);

// A shining rectangle, seen under the tangents `half_size` from its middle; `spread` is its solid
// angle over pi.
struct SoftBox {
  vec3 to;
  vec3 right;
  vec3 up;
  vec2 half_size;
  vec3 radiance;
  float spread;
};
// Overhead.
const SoftBox kCeiling =
    SoftBox(vec3(-0.1881, 0.9407, 0.2822), vec3(0.9806, 0.1961, 0.0000),
            vec3(-0.0553, 0.2767, -0.9594), vec2(0.62, 0.36), vec3(1.02, 1.02, 1.00), 0.228);
// Beside the key light.
const SoftBox kWindow =
    SoftBox(vec3(-0.7599, 0.3397, 0.5543), vec3(0.5893, -0.0000, 0.8079),
            vec3(0.2745, 0.9405, -0.2002), vec2(0.28, 0.44), vec3(1.12, 1.05, 0.94), 0.139);
// Tall, on the right.
const SoftBox kStrip =
    SoftBox(vec3(0.9086, 0.1148, 0.4017), vec3(0.4044, 0.0000, -0.9146),
            vec3(-0.1050, 0.9934, -0.0464), vec2(0.14, 0.90), vec3(0.80, 0.88, 1.02), 0.118);
// Behind the scene, cool.
const SoftBox kRim =
    SoftBox(vec3(0.5200, 0.3971, -0.7563), vec3(-0.8240, 0.0000, -0.5665),
            vec3(-0.2249, 0.9178, 0.3272), vec2(0.46, 0.30), vec3(1.05, 1.30, 1.70), 0.153);

// How much of a box a lobe of this half width sees: the box, blurred along its two edges.
float seen(SoftBox box, vec3 direction, float blur) {
  float ahead = dot(direction, box.to);
  vec2 place = vec2(dot(direction, box.right), dot(direction, box.up)) / max(ahead, 0.05);
  vec4 edges = smoothstep(-blur, blur, vec4(place + box.half_size, place - box.half_size));
  return (edges.x - edges.z) * (edges.y - edges.w) * smoothstep(0.0, 0.3, ahead);
}

vec3 gradient(float y, float blur) {
  vec3 sky = mix(kHorizon, kZenith, smoothstep(0.0, 1.0, y));
  return mix(kGround, sky, smoothstep(-blur, blur, y));
}

// Light from a unit direction as a GGX lobe of this alpha gathers it.
vec3 radiance(vec3 direction, float alpha) {
  float blur = 0.015 + min(2.5 * alpha, 1.5);
  return gradient(direction.y, 0.03 + min(2.0 * alpha, 1.0)) +
         seen(kCeiling, direction, blur) * kCeiling.radiance +
         seen(kWindow, direction, blur) * kWindow.radiance +
         seen(kStrip, direction, blur) * kStrip.radiance +
         seen(kRim, direction, blur) * kRim.radiance;
}

// What a box gives to a diffuse surface: its solid angle's cosine, with a soft end where a part of
// the box has sunk below the horizon.
vec3 diffuse_of(SoftBox box, vec3 normal) {
  float cosine = dot(normal, box.to);
  return box.radiance * (box.spread * 0.5 * (cosine + sqrt(cosine * cosine + 0.05)));
}

// Light from the hemisphere around a normal, over pi.
vec3 irradiance(vec3 normal) {
  return gradient(normal.y, 1.0) + diffuse_of(kCeiling, normal) + diffuse_of(kWindow, normal) +
         diffuse_of(kStrip, normal) + diffuse_of(kRim, normal);
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

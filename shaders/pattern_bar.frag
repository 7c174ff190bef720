// Two bars that move over the wall: how far the pixel is from the middle of the upright and of the
// level one, in pixels, is a function of where it is in its tile.
layout(location = 0) in vec2 ndc;
uniform mat3 off_px_from_ndc;  // x: from the upright bar, y: from the level one
uniform vec2 half_px;          // half of their widths
layout(location = 0) out vec4 out_colour;

void main() {
  vec2 off_px = (off_px_from_ndc * vec3(ndc, 1.0)).xy;
  vec2 cover = clamp(half_px + 0.5 - abs(off_px), 0.0, 1.0);
  vec3 colour = mix(vec3(0.0), vec3(0.34, 0.71, 0.91), cover.y);
  out_colour = vec4(mix(colour, vec3(1.0), cover.x), 1.0);
}

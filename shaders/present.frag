// A picture onto a window or display, mirrored and turned as the display is mounted. Pixel for
// pixel where both have the same size (where a filter would still blur), filtered where they
// differ.
layout(location = 0) in vec2 ndc;
layout(binding = 0) uniform sampler2D picture;
uniform mat3 picture_from_display;  // both from -1 to 1
layout(location = 0) out vec4 out_colour;

void main() {
  vec2 uv = 0.5 * (picture_from_display * vec3(ndc, 1.0)).xy + 0.5;
  vec2 size = vec2(textureSize(picture, 0));
  vec2 texels = fwidth(uv) * size;  // of the picture in one pixel of the display
  bool same_size = all(lessThan(abs(texels - 1.0), vec2(0.01)));
  vec3 filtered = texture(picture, uv).rgb;
  out_colour = vec4(same_size ? texelFetch(picture, ivec2(uv * size), 0).rgb : filtered, 1.0);
}

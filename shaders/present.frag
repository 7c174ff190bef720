// A picture onto a window or display, mirrored and turned as the display is mounted.
layout(location = 0) in vec2 ndc;
layout(binding = 0) uniform sampler2D picture;
uniform mat3 picture_from_display;  // both from -1 to 1
layout(location = 0) out vec4 out_colour;

void main() {
  vec2 place = (picture_from_display * vec3(ndc, 1.0)).xy;
  out_colour = vec4(texture(picture, 0.5 * place + 0.5).rgb, 1.0);
}

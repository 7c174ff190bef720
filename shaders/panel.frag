// The picture's own light, untouched.
layout(location = 0) in vec2 uv;
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 out_colour;

void main() { out_colour = vec4(texture(picture, uv).rgb, 1.0); }

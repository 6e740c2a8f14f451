#version 330 core
// The picture, as it was tone-mapped; at its rim its colours go on.
in vec2 uv;
out vec4 colour;

uniform sampler2D image;

void main() { colour = texture(image, uv); }

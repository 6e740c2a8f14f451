#version 330 core
// A rectangle of the window with a part of the picture; no buffers.
uniform vec4 place;  // x0, y0, x1, y1 in the window, from -1 to 1, y up
uniform vec4 part;   // the same corners in the picture, where it lies from 0 to 1, top row first
out vec2 uv;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  uv = mix(part.xy, part.zw, corner);
  gl_Position = vec4(mix(place.xy, place.zw, corner), 0.0, 1.0);
}

#version 330 core
// Linear light to what the screen shows: the same curves as core/image/tonemap.cpp.
in vec2 uv;
out vec4 colour;

uniform sampler2D image;  // linear Rec.709, top row first
uniform float scale;      // 2^exposure
uniform int curve;        // number of a ToneMap: 0 srgb, clipped; 1 aces, a film's shoulder
uniform int dither;       // 1: rounded to 8 bits by a pattern

// K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015. It is 1 from 7.25 on; the cut keeps infinity out of a division.
vec3 aces(vec3 light) {
  vec3 x = min(light, 10.0);
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// IEC 61966-2-1.
vec3 srgb(vec3 x) {
  vec3 bent = 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055;
  return mix(bent, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}

// Threshold of ordered dithering, as in core/image/tonemap.cpp, in steps of 8 bits: above -1/2 and below 1/2.
float bayer(ivec2 at) {
  int rank = 0;
  for (int bit = 0; bit < 3; ++bit) {
    int across = at.x >> bit & 1, down = at.y >> bit & 1;
    rank |= ((across ^ down) << 1 | down) << 2 * (2 - bit);
  }
  return float(2 * rank + 1) / 128.0 - 0.5;
}

void main() {
  vec3 light = texture(image, uv).rgb * scale;
  light = mix(vec3(0.0), light, greaterThan(light, vec3(0.0)));  // negative or not a number: 0
  if (curve == 1) light = aces(light);
  float moved = dither == 1 ? bayer(ivec2(gl_FragCoord.xy)) / 255.0 : 0.0;
  colour = vec4(srgb(clamp(light, 0.0, 1.0)) + moved, 1.0);
}

#version 330 core
// Linear light to what the screen shows: the same curves as core/image/tonemap.cpp.
in vec2 uv;
out vec4 colour;

uniform sampler2D image;  // linear Rec.709, top row first
uniform float scale;      // 2^exposure
uniform int curve;        // number of a ToneMap: 0 srgb, clipped; 1 aces, a film's shoulder; 2 agx; -1: stops
uniform vec3 stops[13];   // app/window/picture/stops.h
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

// AgX, as in core/image/tonemap.cpp, where its sources are named: code values for a screen of gamma 2.2.
vec3 agx(vec3 light) {
  const mat3 inset = mat3(0.84240107, 0.04240107, 0.04240107, 0.07843650, 0.87843650, 0.07843650, 0.07916243,
                          0.07916243, 0.87916243);  // by columns
  const mat3 outset = mat3(1.19699866, -0.05300134, -0.05300134, -0.09804563, 1.15195437, -0.09804563, -0.09895303,
                           -0.09895303, 1.15104697);
  vec3 way = clamp((log2(max(inset * light, 1e-10)) + 12.473931) / 16.5, 0.0, 1.0) - 20.0 / 33.0;
  vec3 toe = pow(1.0 + 59.507875 * pow(max(-way, 0.0), vec3(3.0)), vec3(-1.0 / 3.0));
  vec3 shoulder = pow(1.0 + 69.862789 * pow(max(way, 0.0), vec3(3.25)), vec3(-4.0 / 13.0));
  vec3 code = 0.5 + 2.0 * way * mix(shoulder, toe, lessThan(way, vec3(0.0)));
  return pow(clamp(outset * pow(max(code, 0.0), vec3(2.2)), 0.0, 1.0), vec3(1.0 / 2.2));
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

// Luminance (Rec.709) in stops from middle grey, as colours; black where there is no light.
vec3 in_stops(vec3 light) {
  float luminance = dot(light, vec3(0.2126, 0.7152, 0.0722));
  if (luminance <= 0.0) return vec3(0.0);
  return stops[int(clamp(floor(log2(luminance / 0.18) + 6.5), 0.0, 12.0))];
}

void main() {
  vec3 light = texture(image, uv).rgb * scale;
  light = mix(vec3(0.0), light, greaterThan(light, vec3(0.0)));  // negative or not a number: 0
  if (curve == 1) light = aces(light);
  vec3 code = curve == -1 ? in_stops(light) : curve == 2 ? agx(min(light, 1e6)) : srgb(clamp(light, 0.0, 1.0));
  float moved = dither == 1 ? bayer(ivec2(gl_FragCoord.xy)) / 255.0 : 0.0;
  colour = vec4(code + moved, 1.0);
}

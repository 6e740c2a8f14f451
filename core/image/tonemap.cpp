#include "core/image/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {

float srgb_encode(float linear) {
  if (linear <= 0.0031308f) return 12.92f * linear;
  return 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

namespace {

/// The curve's value in [0, 1]. The fit is 1 from x = 7.25 on; x is cut at 10 only so that infinity is not divided by
/// infinity.
float aces(float x) {
  const float v = std::min(x, 10.0f);
  return v * (2.51f * v + 0.03f) / (v * (2.43f * v + 0.59f) + 0.14f);
}

using Rgb = std::array<float, 3>;

/// Light drawn together before AgX's contrast and apart after it, so that bright colours fade. Rows add up to 1.
constexpr Rgb agx_inset[3] = {{0.84240107f, 0.07843650f, 0.07916243f},
                              {0.04240107f, 0.87843650f, 0.07916243f},
                              {0.04240107f, 0.07843650f, 0.87916243f}};
constexpr Rgb agx_outset[3] = {{1.19699866f, -0.09804563f, -0.09895303f},
                               {-0.05300134f, 1.15195437f, -0.09895303f},
                               {-0.05300134f, -0.09804563f, 1.15104697f}};

Rgb times(const Rgb (&matrix)[3], const Rgb& v) {
  const auto row = [&](const Rgb& r) { return r[0] * v[0] + r[1] * v[1] + r[2] * v[2]; };
  return {row(matrix[0]), row(matrix[1]), row(matrix[2])};
}

/// Code values in [0, 1] for a screen of gamma 2.2.
Rgb agx(const Rgb& light) {
  constexpr float darkest = -12.473931f, stops = 16.5f;  // log2(0.18) - 10; up to log2(0.18) + 6.5
  Rgb shown = times(agx_inset, light);
  for (float& v : shown) {
    const float x = std::clamp((std::log2(std::max(v, 1e-10f)) - darkest) / stops, 0.0f, 1.0f);
    v = std::pow(agx_contrast(x), 2.2f);
  }
  shown = times(agx_outset, shown);
  for (float& v : shown) v = std::pow(std::clamp(v, 0.0f, 1.0f), 1 / 2.2f);
  return shown;
}

/// Code values in [0, 1] of light that was multiplied by the exposure; negative light and what is not a number is 0.
Rgb screen_values(Rgb light, ToneMap curve) {
  for (float& v : light) v = v > 0 ? std::min(v, 1e6f) : 0.0f;
  if (curve == ToneMap::agx) return agx(light);
  for (float& v : light) v = srgb_encode(std::min(curve == ToneMap::aces ? aces(v) : v, 1.0f));
  return light;
}

/// The screen's 0 to 255 of each channel, not yet rounded, is handed to round(pixel, value).
template <class Round>
std::vector<std::uint8_t> map_pixels(const std::vector<float>& rgb, double exposure, ToneMap curve,
                                     const Round& round) {
  const double gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes(rgb.size());
  const auto exposed = [&](std::size_t i) { return static_cast<float>(static_cast<double>(rgb[i]) * gain); };
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const Rgb shown = screen_values({exposed(i), exposed(i + 1), exposed(i + 2)}, curve);
    for (std::size_t c = 0; c < 3; ++c) bytes[i + c] = static_cast<std::uint8_t>(round(i / 3, 255 * shown[c]));
  }
  return bytes;
}

/// Threshold of ordered dithering in a square of 8 x 8 pixels: each of (2 k + 1) / 128 - 1/2, k from 0 to 63, once.
/// B. E. Bayer: An Optimum Method for Two-Level Rendition of Continuous-Tone Pictures, 1973.
float bayer(unsigned x, unsigned y) {
  unsigned rank = 0;
  for (unsigned bit = 0; bit < 3; ++bit) {
    const unsigned across = x >> bit & 1u, down = y >> bit & 1u;
    rank |= ((across ^ down) << 1u | down) << 2u * (2 - bit);
  }
  return static_cast<float>(2 * rank + 1) / 128 - 0.5f;
}

}  // namespace

float agx_contrast(float x) {
  constexpr float pivot = 20.0f / 33, toe = 59.507875f, shoulder = 69.862789f;
  const float way = x - pivot;
  const float bend = way < 0 ? std::pow(1 + toe * std::pow(-way, 3.0f), -1 / 3.0f)
                             : std::pow(1 + shoulder * std::pow(way, 3.25f), -4 / 13.0f);
  return 0.5f + 2 * way * bend;
}

std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneMap curve) {
  return map_pixels(rgb, exposure, curve, [](std::size_t, float value) { return std::lround(value); });
}

std::vector<std::uint8_t> tone_map_dithered(const std::vector<float>& rgb, double exposure, ToneMap curve, int width,
                                            DitherOrigin origin) {
  return map_pixels(rgb, exposure, curve, [&](std::size_t pixel, float value) {
    const unsigned x = static_cast<unsigned>(pixel % static_cast<std::size_t>(width)) + static_cast<unsigned>(origin.x);
    const unsigned y = static_cast<unsigned>(pixel / static_cast<std::size_t>(width)) + static_cast<unsigned>(origin.y);
    return std::lround(value + bayer(x, y));
  });
}

}  // namespace tyndall

#include "core/image/tonemap.h"

#include <algorithm>
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

/// value: > 0. The result may exceed 1, which is clipped later.
float curved(float value, ToneMap curve) {
  switch (curve) {
    case ToneMap::srgb:
      return value;
    case ToneMap::aces:
      return aces(value);
  }
  return value;
}

/// A value as the screen's 0 to 255, not yet rounded; negative ones and what is not a number give 0.
float screen_value(float linear, double gain, ToneMap curve) {
  const float value = static_cast<float>(static_cast<double>(linear) * gain);
  if (!(value > 0)) return 0;
  return 255 * srgb_encode(std::min(curved(value, curve), 1.0f));
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

std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneMap curve) {
  const double gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(std::lround(screen_value(rgb[i], gain, curve)));
  return bytes;
}

std::vector<std::uint8_t> tone_map_dithered(const std::vector<float>& rgb, double exposure, ToneMap curve, int width,
                                            DitherOrigin origin) {
  const double gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes(rgb.size());
  const auto row = 3 * static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const unsigned x = static_cast<unsigned>(i % row / 3) + static_cast<unsigned>(origin.x);
    const unsigned y = static_cast<unsigned>(i / row) + static_cast<unsigned>(origin.y);
    bytes[i] = static_cast<std::uint8_t>(std::lround(screen_value(rgb[i], gain, curve) + bayer(x, y)));
  }
  return bytes;
}

}  // namespace tyndall

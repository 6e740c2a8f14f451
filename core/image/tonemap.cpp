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

}  // namespace

std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneMap curve) {
  const double gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float value = static_cast<float>(static_cast<double>(rgb[i]) * gain);
    if (!(value > 0)) continue;  // negative or not a number: 0
    bytes[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_encode(std::min(curved(value, curve), 1.0f))));
  }
  return bytes;
}

}  // namespace tyndall

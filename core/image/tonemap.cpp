#include "core/image/tonemap.h"

#include "core/base/elementary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace tyndall {
namespace {

float power(float base, float exponent) { return static_cast<float>(to_the_power(base, exponent)); }

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

/// A function of light as straight pieces, 64 for each doubling from 2^-40 to 2^20, which stand for all that is darker
/// or brighter; what is not a number is as dark.
class Pieces {
 public:
  template <class Function>
  explicit Pieces(const Function& exact) : ends_(count + 1) {
    for (std::uint32_t i = 0; i <= count; ++i) ends_[i] = exact(std::bit_cast<float>(first + (i << piece_bits)));
  }
  float operator()(float light) const {
    const float within = light > darkest ? std::min(light, brightest) : darkest;
    const std::uint32_t at = std::bit_cast<std::uint32_t>(within) - first, i = at >> piece_bits;
    const float fraction = static_cast<float>(at & (piece - 1)) * (1.0f / piece);
    return ends_[i] + fraction * (ends_[i + 1] - ends_[i]);
  }

 private:
  static constexpr std::uint32_t piece_bits = 23 - 6, piece = 1u << piece_bits;
  static constexpr float darkest = 0x1p-40f, brightest = 0x1p20f - 1;
  static constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(darkest), count = 60 * 64;
  std::vector<float> ends_;
};

/// The pieces of a function, which are computed once.
template <float (*exact)(float)>
const Pieces& pieces_of() {
  static const Pieces pieces(exact);
  return pieces;
}

float srgb_code(float light) { return 255 * srgb_encode(std::min(light, 1.0f)); }
float aces_code(float light) { return srgb_code(aces(light)); }
float gamma22_code(float light) { return 255 * power(std::min(light, 1.0f), 1 / 2.2f); }
/// What a screen shines for one channel of AgX.
float agx_light(float light) {
  constexpr float darkest = -12.473931f, stops = 16.5f;  // log2(0.18) - 10; up to log2(0.18) + 6.5
  return power(agx_contrast(std::clamp((static_cast<float>(binary_logarithm(light)) - darkest) / stops, 0.0f, 1.0f)),
               2.2f);
}

/// Code values of 0 to 255, channel by channel.
struct ChannelCurve {
  const Pieces& code;
  Rgb operator()(const Rgb& light) const { return {code(light[0]), code(light[1]), code(light[2])}; }
};

/// Code values of 0 to 255 for a screen of gamma 2.2.
struct AgxCurve {
  const Pieces &contrast = pieces_of<agx_light>(), &code = pieces_of<gamma22_code>();
  Rgb operator()(const Rgb& light) const { return ChannelCurve{code}(shown(light)); }
  /// What the screen shines.
  Rgb shown(Rgb light) const {
    for (float& v : light) v = v > 0 ? std::min(v, 1e6f) : 0.0f;
    return times(agx_outset, ChannelCurve{contrast}(times(agx_inset, light)));
  }
};

/// Whole code values of 0 to 255 by the square root.
struct Gamma2Curve {
  ToneMap curve;
  AgxCurve agx{};
  Rgb operator()(const Rgb& light) const {
    Rgb code = curve == ToneMap::agx ? agx.shown(light) : light;
    for (float& v : code) {
      const float bent = curve == ToneMap::aces && v > 0 ? aces(v) : v;
      const double root = bent > 0 ? std::min(std::sqrt(static_cast<double>(bent)), 0.999) : 0.0;
      v = static_cast<float>(std::floor(256 * root));
    }
    return code;
  }
};

/// What is added before a value is cut to a whole number.
using Offsets = std::array<std::array<float, 8>, 8>;

/// To the nearest.
constexpr Offsets nearest = [] {
  Offsets halves;
  for (auto& row : halves) row.fill(0.5f);
  return halves;
}();

/// Ordered dithering in a square of 8 x 8 pixels: each of (2 k + 1) / 128, k from 0 to 63, once.
/// B. E. Bayer: An Optimum Method for Two-Level Rendition of Continuous-Tone Pictures, 1973.
constexpr Offsets bayer = [] {
  Offsets offsets;
  for (unsigned y = 0; y < 8; ++y)
    for (unsigned x = 0; x < 8; ++x) {
      unsigned rank = 0;
      for (unsigned bit = 0; bit < 3; ++bit) {
        const unsigned across = x >> bit & 1u, down = y >> bit & 1u;
        rank |= ((across ^ down) << 1u | down) << 2u * (2 - bit);
      }
      offsets[y][x] = static_cast<float>(2 * rank + 1) / 128;
    }
  return offsets;
}();

/// How pixels lie in memory and in the picture. channels: floats and bytes a pixel, 3 or 4.
struct Pixels {
  std::size_t channels, width;
  DitherOrigin origin;
};

template <class Curve>
void map_pixels(const std::vector<float>& light, double exposure, const Curve& curve, const Offsets& offsets,
                const Pixels& pixels, std::vector<std::uint8_t>& bytes) {
  const float gain = static_cast<float>(to_the_power(2, exposure));
  bytes.resize(light.size());
  unsigned y = static_cast<unsigned>(pixels.origin.y);
  for (std::size_t row = 0; row < light.size(); row += pixels.channels * pixels.width, ++y) {
    const std::size_t end = std::min(light.size(), row + pixels.channels * pixels.width);
    unsigned x = static_cast<unsigned>(pixels.origin.x);
    for (std::size_t i = row; i + 2 < end; i += pixels.channels, ++x) {
      const Rgb code = curve({gain * light[i], gain * light[i + 1], gain * light[i + 2]});
      for (std::size_t c = 0; c < 3; ++c)
        bytes[i + c] = static_cast<std::uint8_t>(static_cast<int>(code[c] + offsets[y % 8][x % 8]));
      if (pixels.channels == 4) bytes[i + 3] = 255;
    }
  }
}

void map_by(ToneMap curve, const std::vector<float>& light, double exposure, const Offsets& offsets,
            const Pixels& pixels, std::vector<std::uint8_t>& bytes) {
  if (curve == ToneMap::agx) return map_pixels(light, exposure, AgxCurve{}, offsets, pixels, bytes);
  const Pieces& code = curve == ToneMap::aces ? pieces_of<aces_code>() : pieces_of<srgb_code>();
  map_pixels(light, exposure, ChannelCurve{code}, offsets, pixels, bytes);
}

}  // namespace

float srgb_encode(float linear) {
  if (linear <= 0.0031308f) return 12.92f * linear;
  return 1.055f * power(linear, 1 / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return power((encoded + 0.055f) / 1.055f, 2.4f);
}

float agx_contrast(float x) {
  constexpr float pivot = 20.0f / 33, toe = 59.507875f, shoulder = 69.862789f;
  const float offset = x - pivot;
  const float bend = offset < 0 ? power(1 + toe * power(-offset, 3.0f), -1 / 3.0f)
                                : power(1 + shoulder * power(offset, 3.25f), -4 / 13.0f);
  return 0.5f + 2 * offset * bend;
}

std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneMap curve, int width,
                                   std::optional<DitherOrigin> dither) {
  const Pixels pixels{3, dither ? static_cast<std::size_t>(width) : rgb.size(), dither.value_or(DitherOrigin{})};
  std::vector<std::uint8_t> bytes;
  map_by(curve, rgb, exposure, dither ? bayer : nearest, pixels, bytes);
  return bytes;
}

std::vector<std::uint8_t> gamma2_bytes(const std::vector<float>& rgb, double exposure, ToneMap curve) {
  constexpr Offsets none{};
  std::vector<std::uint8_t> bytes;
  map_pixels(rgb, exposure, Gamma2Curve{curve}, none, {3, rgb.size(), {}}, bytes);
  return bytes;
}

void tone_map_rgba(const std::vector<float>& rgba, double exposure, ToneMap curve, int width, bool dither,
                   std::vector<std::uint8_t>& bytes) {
  map_by(curve, rgba, exposure, dither ? bayer : nearest, {4, static_cast<std::size_t>(width), {}}, bytes);
}

}  // namespace tyndall

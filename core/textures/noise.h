#pragma once
#include "core/base/choice.h"
#include "core/base/fields.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/textures/point.h"

#include <tuple>

/// Noise and marble: what users set, and their colour at a point.
namespace tyndall {

enum class NoiseStyle { perlin, turbulence, marble };

constexpr Word word(NoiseStyle style) {
  switch (style) {
    case NoiseStyle::perlin:
      return {"perlin", "one octave"};
    case NoiseStyle::turbulence:
      return {"turbulence", "seven octaves, absolute sum"};
    case NoiseStyle::marble:
      return {"marble", "a sine along z, its phase shifted by turbulence"};
  }
  return {};
}

/// Gradient noise in space: "perlin" is smooth, "turbulence" adds seven octaves of it, "marble" bends veins across z.
template <class F = double>
struct Noise {
  static constexpr const char* type = "noise";
  static constexpr const char* about = "Grey gradient noise in space.";
  using Style = NoiseStyle;
  F scale = F(1);
  Style style = Style::marble;
  bool operator==(const Noise&) const = default;
};

template <class F>
constexpr auto fields(const Noise<F>*) {
  return std::tuple{Field{"scale", &Noise<F>::scale, above(0), Slider{0.01, 100, true}, "",
                          "lattice cells per scene unit; marble: veins per 2π scene units", true},
                    Field{"style", &Noise<F>::style, "what the noise is made into"}};
}

/// The part of the noise that one lattice point gives: its gradient times the offset from it. The gradient is one of
/// 256 unit vectors; the lattice repeats every 256 cells. x, y, z: coordinates of the lattice point.
template <class F>
TYNDALL_INLINE F lattice_gradient(IntOf<F> x, IntOf<F> y, IntOf<F> z, Vec3<F> offset, const float* gradients) {
  using U = UintOf<F>;
  const U mixed =
      hash((as_uint(x) & U(255u)) | shift_left<8>(as_uint(y) & U(255u)) | shift_left<16>(as_uint(z) & U(255u)));
  const IntOf<F> at = as_int(shift_right<24>(mixed)) * IntOf<F>(3);
  return dot(Vec3<F>{gather<F>(gradients, at), gather<F>(gradients + 1, at), gather<F>(gradients + 2, at)}, offset);
}

/// Gradient noise in about [-1, 1], 0 at lattice points. gradients: 3·256 floats.
/// K. Perlin, An Image Synthesizer, SIGGRAPH 1985, with the Hermite weights of The Next Week, section 5.
template <class F>
TYNDALL_INLINE F gradient_noise(Vec3<F> p, const float* gradients) {
  using I = IntOf<F>;
  const Vec3<F> cell{floor(p.x), floor(p.y), floor(p.z)};
  const Vec3<F> f = p - cell;
  const I x = to_int(cell.x), y = to_int(cell.y), z = to_int(cell.z);
  const auto smooth = [](F t) { return t * t * mul_add(F(-2.0f), t, F(3.0f)); };
  const F wx = smooth(f.x), wy = smooth(f.y), wz = smooth(f.z);
  F sum = F(0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const Vec3<F> offset{f.x - F(static_cast<float>(i)), f.y - F(static_cast<float>(j)),
                         f.z - F(static_cast<float>(k))};
    const F weight = (i ? wx : F(1.0f) - wx) * (j ? wy : F(1.0f) - wy) * (k ? wz : F(1.0f) - wz);
    sum = mul_add(weight, lattice_gradient(x + I(i), y + I(j), z + I(k), offset, gradients), sum);
  }
  return sum;
}

/// |Σ noise(2^i p) / 2^i| over seven octaves. The Next Week, section 5.6 "Introducing Turbulence".
template <class F>
TYNDALL_INLINE F turbulence(Vec3<F> p, const float* gradients) {
  F sum = F(0.0f);
  float weight = 1.0f, frequency = 1.0f;
  for (int octave = 0; octave < 7; ++octave, weight *= 0.5f, frequency *= 2.0f)
    sum = mul_add(F(weight), gradient_noise(F(frequency) * p, gradients), sum);
  return abs(sum);
}

/// Grey value in [0, 1] for a style. p: scale · position, for marble the position (both modulo 256); z_turn: scale · z
/// / 2π.
template <class F>
TYNDALL_INLINE F noise_grey(NoiseStyle style, Vec3<F> p, F z_turn, const float* gradients) {
  if (style == NoiseStyle::perlin) return F(0.5f) * (F(1.0f) + gradient_noise(p, gradients));
  const F t = turbulence(p, gradients);
  if (style == NoiseStyle::turbulence) return t;
  const F turn = mul_add(t, F(static_cast<float>(10 / (2 * pi))), z_turn);
  const F wave = sin_cos_turn(turn - floor(turn)).sin;  // can pass 1 by a rounding
  return F(0.5f) * (F(1.0f) + min(max(wave, F(-1.0f)), F(1.0f)));
}

template <class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_at(const Noise<F>*, const auto& columns, const TexturePoint<F, Uv>& at) {
  const F turn = mul_add(splat<F>(columns.z_scale), at.point.z, splat<F>(columns.z_offset));
  const F grey = noise_grey(columns.style, at.scaled, turn, at.gradients);
  return {grey, grey, grey};
}

}  // namespace tyndall

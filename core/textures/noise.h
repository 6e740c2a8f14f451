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

constexpr Label label(NoiseStyle style) {
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
  return std::tuple{
      Field{"scale", &Noise<F>::scale, above(0), Slider{0.01, 100, true}, "",
            "lattice cells per scene unit; marble: veins per 2π scene units", true}
          .also("texture scale, frequency, tiling"),
      Field{"style", &Noise<F>::style, "what the noise is made into"}.also("noise style, marble, turbulence")};
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

inline constexpr int octaves = 7;

/// The octaves of turbulence for few lanes: each of these lanes' points takes as many lanes as there are octaves, so
/// that all lanes work. wanted: a bit for each lane; the numbers of the others mean nothing. noise: octave by octave.
template <class F>
TYNDALL_INLINE void find_few_octaves(Vec3<F> p, std::uint32_t wanted, const float* gradients,
                                     float (&noise)[octaves][lanes_of<F>]) {
  constexpr int lanes = lanes_of<F>, row = 8, points = lanes / row;
  alignas(64) float from[3][lanes], x[lanes], y[lanes], z[lanes], made[lanes], frequency[lanes];
  store(from[0], p.x), store(from[1], p.y), store(from[2], p.z);
  for (int i = 0; i < lanes; ++i) frequency[i] = static_cast<float>(1 << i % row);
  while (wanted) {
    int lane[points], count = 0;
    for (; wanted && count < points; wanted &= wanted - 1) lane[count++] = __builtin_ctz(wanted);
    for (int i = 0; i < lanes; ++i) {
      const int point = lane[i / row < count ? i / row : 0];
      x[i] = from[0][point], y[i] = from[1][point], z[i] = from[2][point];
    }
    const Vec3<F> finer = load<F>(frequency) * Vec3<F>{load<F>(x), load<F>(y), load<F>(z)};
    store(made, gradient_noise(finer, gradients));
    for (int i = 0; i < count; ++i)
      for (int octave = 0; octave < octaves; ++octave) noise[octave][lane[i]] = made[row * i + octave];
  }
}

/// |Σ noise(2^i p) / 2^i| over seven octaves. The Next Week, section 5.6 "Introducing Turbulence". lanes: those whose
/// turbulence is wanted. It is the same for any company.
template <class F>
TYNDALL_INLINE F turbulence(Vec3<F> p, MaskOf<F> lanes, const float* gradients) {
  F sum = F(0.0f);
  float weight = 1.0f, frequency = 1.0f;
  if constexpr (lanes_of<F> >= 8) {
    const std::uint32_t wanted = bits(lanes);
    if (__builtin_popcount(wanted) <= lanes_of<F> / 8 * (octaves - 2)) {
      alignas(64) float noise[octaves][lanes_of<F>] = {};
      find_few_octaves(p, wanted, gradients, noise);
      for (int octave = 0; octave < octaves; ++octave, weight *= 0.5f)
        sum = mul_add(F(weight), load<F>(noise[octave]), sum);
      return abs(sum);
    }
  }
  for (int octave = 0; octave < octaves; ++octave, weight *= 0.5f, frequency *= 2.0f)
    sum = mul_add(F(weight), gradient_noise(F(frequency) * p, gradients), sum);
  return abs(sum);
}

/// Grey value in [0, 1] for a style. p: scale · position, for marble the position (both modulo 256); z_phase: scale · z
/// / 2π. lanes: those whose value is wanted.
template <class F>
TYNDALL_INLINE F noise_grey(NoiseStyle style, Vec3<F> p, F z_phase, MaskOf<F> lanes, const float* gradients) {
  if (style == NoiseStyle::perlin) return F(0.5f) * (F(1.0f) + gradient_noise(p, gradients));
  const F t = turbulence(p, lanes, gradients);
  if (style == NoiseStyle::turbulence) return t;
  const F phase = mul_add(t, F(static_cast<float>(10 / (2 * pi))), z_phase);
  const F wave = sin_cos_2pi(phase - floor(phase)).sin;  // can pass 1 by a rounding
  return F(0.5f) * (F(1.0f) + min(max(wave, F(-1.0f)), F(1.0f)));
}

template <class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_at(const Noise<F>*, const auto& columns, const TexturePoint<F, Uv>& at) {
  const F phase = mul_add(splat<F>(columns.z_scale), at.point.z, splat<F>(columns.z_offset));
  const F grey = noise_grey(columns.style, at.scaled, phase, at.wanted, at.gradients);
  return {grey, grey, grey};
}

}  // namespace tyndall

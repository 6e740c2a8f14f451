#pragma once
#include "core/clean/cells.h"

/// A small blur that knows nothing of what is seen: for glass, soft focus and motion, which the regression cannot
/// explain.
namespace tyndall::filter {

inline constexpr int chunk = 256;  ///< pixels of a row that are treated together

/// A piece of a row of both halves.
struct ChunkOfHalves {
  alignas(64) float of[outputs][chunk];
};

TYNDALL_INLINE int mirrored(int i, int count) {
  const int j = i < 0 ? -i - 1 : i >= count ? 2 * count - 1 - i : i;
  return most(0, least(j, count - 1));
}

inline constexpr int blur_reach = 2;

/// Whether a cell that the blur of these pixels reads has emission.
TYNDALL_INLINE bool emission_near(const FilterView& v, int y, int x0, int count) {
  if (!v.has_emission()) return false;
  const int bottom = least(y + blur_reach, v.height - 1) / cell_edge, right = (x0 + count + blur_reach) / cell_edge;
  bool any = false;
  for (int cy = most(y - blur_reach, 0) / cell_edge; cy <= bottom; ++cy)
    for (int cx = x0 / cell_edge - 1; cx <= right; ++cx) any |= v.shines[(cy + 1) * v.cell_stride + cx + 1] != 0;
  return any;
}

/// How much of a half's emission is spread: none where it is seen sharply, as the dark around a lamp that is smaller
/// than a pixel would be spoilt by far more than the lamp gains. Else, behind glass or in brushed metal, at most as
/// much as the eight pixels around have together, so that a lone speck stays where it is.
template <class F>
TYNDALL_INLINE F spread_emission(const FilterView& v, int output, int y, std::ptrdiff_t at) {
  const F own = load<F>(v.emission[output] + at);
  F others = F(0.0f) - own;
  for (int k = y > 0 ? -1 : 0; k <= (y + 1 < v.height ? 1 : 0); ++k) {
    const float* row = v.emission[output] + at + k * v.stride;
    others = others + (load<F>(row - 1) + load<F>(row) + load<F>(row + 1));
  }
  const F spread = max(min(own, others), F(0.0f));
  return select(less(F(0.0f), load<F>(v.sharp + at)), F(0.0f), spread);
}

/// What of a half is blurred.
template <class F>
TYNDALL_INLINE F blurred_part(const FilterView& v, bool lit, int output, int y, std::ptrdiff_t at) {
  const F half = load<F>(v.half[output] + at);
  return lit ? half - load<F>(v.emission[output] + at) + spread_emission<F>(v, output, y, at) : half;
}

/// Binomial filter of 5 x 5 taps, of `count` pixels from x0 on in row y; mirrored at the borders. A half that the
/// regression has left as it was stays so.
template <class F>
TYNDALL_INLINE void blur_chunk(const FilterView& v, int y, int x0, int count, ChunkOfHalves& to) {
  constexpr int reach = blur_reach;
  alignas(64) float column[chunk + 64];  // from x0 - 16 on
  const bool lit = emission_near(v, y, x0, count);
  int line[2 * reach + 1];
  for (int k = -reach; k <= reach; ++k) line[k + reach] = mirrored(y + k, v.height);
  const std::ptrdiff_t own = y * v.stride + x0;
  for (int output = 0; output < outputs; ++output) {
    const auto part = [&](int k, int x) {
      return blurred_part<F>(v, lit, output, line[k], line[k] * v.stride + x0 + x);
    };
    for (int x = -row_margin; x < count + reach; x += lanes_of<F>) {
      const F outer = part(0, x) + part(4, x), inner = part(1, x) + part(3, x);
      store(column + row_margin + x, mul_add(F(0.25f), inner, mul_add(F(0.375f), part(2, x), F(0.0625f) * outer)));
    }
    float* at = column + row_margin;
    for (int k = 1; k <= reach && x0 == 0; ++k) at[-k] = at[least(k - 1, v.width - 1)];
    for (int k = 0; k < reach && x0 + count == v.width; ++k) at[count + k] = at[mirrored(v.width + k, v.width) - x0];
    for (int x = 0; x < count; x += lanes_of<F>) {
      const F outer = load<F>(at + x - 2) + load<F>(at + x + 2), inner = load<F>(at + x - 1) + load<F>(at + x + 1);
      const F blurred = mul_add(F(0.25f), inner, mul_add(F(0.375f), load<F>(at + x), F(0.0625f) * outer));
      const F half = load<F>(v.half[output] + own + x), kept = half - blurred_part<F>(v, lit, output, y, own + x);
      const auto left = equal(load<F>(v.filtered[output] + own + x), half);
      store(to.of[output] + x, select(left, half, blurred + kept));
    }
  }
}

}  // namespace tyndall::filter

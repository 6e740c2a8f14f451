#pragma once
#include "core/clean/cells.h"

/// A small blur that does not use the first-seen features (albedo, normal, depth). It helps behind glass, in soft focus
/// and in motion, which the regression cannot explain.
namespace tyndall::filter {

inline constexpr int chunk = 256;  ///< pixels of a row that are treated together

/// A piece of a row of both halves.
struct ChunkOfHalves {
  alignas(64) float of[outputs][chunk];
};

TYNDALL_INLINE int mirrored(int i, int count) {
  const int j = i < 0 ? -i - 1 : i >= count ? 2 * count - 1 - i : i;
  return maximum(0, minimum(j, count - 1));
}

/// Prefetches the memory of a later row: rows are too short for the processor to foresee the access.
TYNDALL_INLINE void fetch(const FilterView& v, const float* plane, int y, int x) {
  __builtin_prefetch(plane + std::ptrdiff_t{y} * v.stride + x);  // behind the picture it does nothing
}

inline constexpr int blur_reach = 2;

/// Whether a cell that the blur of these pixels reads has emission.
TYNDALL_INLINE bool emission_near(const FilterView& v, int y, int x0, int count) {
  if (!v.has_emission()) return false;
  const int bottom = minimum(y + blur_reach, v.height - 1) / cell_edge, right = (x0 + count + blur_reach) / cell_edge;
  bool any = false;
  for (int cy = maximum(y - blur_reach, 0) / cell_edge; cy <= bottom; ++cy)
    for (int cx = x0 / cell_edge - 1; cx <= right; ++cx) any |= v.shines[(cy + 1) * v.cell_stride + cx + 1] != 0;
  return any;
}

/// Returns the values of a half that are to be blurred. If `lit`, without its sharp emission: a light smaller than a
/// pixel gains little by being blurred, and would spoil the dark pixels around it.
template <class F, bool lit>
TYNDALL_INLINE F blurred_part(const FilterView& v, int output, std::ptrdiff_t at) {
  const F half = load<F>(v.half[output] + at);
  return lit ? neg_mul_add(load<F>(v.sharp + at), load<F>(v.emission[output] + at), half) : half;
}

/// Blurs `count` pixels of row y, from x0 on, with a binomial filter of 5 x 5 taps, mirrored at the picture's borders.
/// Pixels of a half that the regression left unchanged stay unchanged.
template <class F, bool lit>
TYNDALL_INLINE void blur_lit_chunk(const FilterView& v, int y, int x0, int count, ChunkOfHalves& to) {
  constexpr int reach = blur_reach;
  alignas(64) float column[chunk + 64];  // from x0 - 16 on
  std::ptrdiff_t row[2 * reach + 1];
  for (int k = -reach; k <= reach; ++k) row[k + reach] = mirrored(y + k, v.height) * v.stride + x0;
  for (int output = 0; output < outputs; ++output) {
    const auto part = [&](int k, int x) { return blurred_part<F, lit>(v, output, row[k] + x); };
    for (int x = -row_margin; x < count + reach; x += lanes_of<F>) {
      fetch(v, v.half[output], y + reach + 1, x0 + x);
      fetch(v, v.filtered[output], y + 1, x0 + x);
      const F outer = part(0, x) + part(4, x), inner = part(1, x) + part(3, x);
      store(column + row_margin + x, mul_add(F(0.25f), inner, mul_add(F(0.375f), part(2, x), F(0.0625f) * outer)));
    }
    float* at = column + row_margin;
    for (int k = 1; k <= reach && x0 == 0; ++k) at[-k] = at[minimum(k - 1, v.width - 1)];
    for (int k = 0; k < reach && x0 + count == v.width; ++k) at[count + k] = at[mirrored(v.width + k, v.width) - x0];
    for (int x = 0; x < count; x += lanes_of<F>) {
      const F outer = load<F>(at + x - 2) + load<F>(at + x + 2), inner = load<F>(at + x - 1) + load<F>(at + x + 1);
      const F blurred = mul_add(F(0.25f), inner, mul_add(F(0.375f), load<F>(at + x), F(0.0625f) * outer));
      const F half = load<F>(v.half[output] + row[reach] + x),
              kept = half - blurred_part<F, lit>(v, output, row[reach] + x);
      const auto left = equal(load<F>(v.filtered[output] + row[reach] + x), half);
      store(to.of[output] + x, select(left, half, blurred + kept));
    }
  }
}
template <class F>
TYNDALL_INLINE void blur_chunk(const FilterView& v, int y, int x0, int count, ChunkOfHalves& to) {
  if (emission_near(v, y, x0, count)) return blur_lit_chunk<F, true>(v, y, x0, count, to);
  blur_lit_chunk<F, false>(v, y, x0, count, to);
}

}  // namespace tyndall::filter

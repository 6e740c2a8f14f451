#pragma once
#include "core/clean/blur.h"
#include "core/film/groups.h"

/// How wrong a filtered picture is, and how much another picture should be mixed in, told by the two halves A and B of
/// the samples. A filter turns A into PA and B into PB, without looking at the other half. If I is the truth, P is
/// (PA + PB) / 2, and Q is the other picture, made from halves in the same way, then
///
///     E[(P-I)²]      = E[(PA-A)(PB-B)] + E[(PA-PB)²] / 4
///     E[(P-I)(P-Q)]  = E[(PA-A)(PB-QB) + (PB-B)(PA-QA)] / 2 + E[(PA-PB)((PA-PB) - (QA-QB))] / 4
///
/// because A and B are independent and right on average. This needs no model of the noise and holds for any sampler.
namespace tyndall::filter {

inline constexpr int window_reach = 6;  ///< a choice is made from 13 x 13 pixels …
inline constexpr int hole_reach = 1;  ///< … without the middle 3 x 3: with its own residuals, they would not tell the
                                      ///< error of what was chosen any more

/// Whether the noise of pixels k columns (or rows) away from the middle may depend on the middle's noise, given that
/// their rows (or columns) allow it. spacing: in pixels, of the groups that share second vertices (see FilterView); 0:
/// no groups.
template <int spacing>
constexpr bool in_hole(int k) {
  const int away = k < 0 ? -k : k, beyond = spacing > 0 ? away % spacing : away;
  return beyond <= hole_reach || (spacing > 0 && beyond >= spacing - hole_reach);
}

/// Fills in the picture that may be mixed in, for `count` pixels of row y from x0 on.
template <class F>
TYNDALL_INLINE void take_rival(const FilterView& v, Rival rival, int y, int x0, int count, ChunkOfHalves& to) {
  if (rival == Rival::blurred) return blur_chunk<F>(v, y, x0, count, to);
  for (int output = 0; output < outputs; ++output)
    for (int x = 0; x < count; x += lanes_of<F>) {
      fetch(v, v.half[output], y + 1, x0 + x);
      fetch(v, v.filtered[output], y + 1, x0 + x);
      store(to.of[output] + x, load<F>(v.half[output] + y * v.stride + x0 + x));
    }
}

/// The x of each lane's pixel, from `x` on.
template <class F>
TYNDALL_INLINE F places(int x) {
  alignas(64) static constexpr float place[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(lanes_of<F> <= 16);
  return splat<F>(static_cast<float>(x)) + load<F>(place);
}

/// Number of pixels that a window around `at` covers in one direction, inside the picture. reach: of the window to each
/// side; size: of the picture.
template <class F>
TYNDALL_INLINE F covered(F at, int reach, int size) {
  const F last = splat<F>(static_cast<float>(size - 1)), half = splat<F>(static_cast<float>(reach));
  return max(min(at + half, last) - max(at - half, F(0.0f)) + F(1.0f), F(1.0f));
}

/// Number of pixels of the square window around (x, y) that are inside the picture; lane i is for x + i.
template <class F>
TYNDALL_INLINE F pixels_around(const FilterView& v, int y, int x, int reach) {
  return covered(places<F>(x), reach, v.width) * covered(splat<F>(static_cast<float>(y)), reach, v.height);
}

/// Sets what stands behind a row to 0: windows at the right border of the picture read it.
TYNDALL_INLINE void clear_behind(float* row, int width) {
  for (int x = width; x < width + row_margin; ++x) row[x] = 0;
}

/// Returns the level to which errors at a pixel are relative: the mean of the 3 x 3 pixels around, which is less noisy
/// than the pixel's own value. Where the pixel is much darker than its neighbours, and wherever a light is seen
/// sharply, the level is at most the pixel's own value: next to a light no neighbour tells how dark the pixel is.
template <class F>
TYNDALL_INLINE F level_around(const FilterView& v, int y, int x) {
  const std::ptrdiff_t at = y * v.stride + x;
  F sum = F(0.0f);
  for (int k = maximum(y - 1, 0); k <= minimum(y + 1, v.height - 1); ++k) {
    const float* middle = v.level + k * v.stride + x;
    sum = sum + (load<F>(middle - 1) + load<F>(middle) + load<F>(middle + 1));
  }
  const F around = max(sum / pixels_around<F>(v, y, x, 1), F(0.0f));
  const F darker = max(min(load<F>(v.level + at), around), F(0.0f));
  return select(less(F(0.0f), load<F>(v.sharp + at)), darker, select(less(darker, F(0.1f) * around), darker, around));
}

/// A pixel counts less if the two pictures differ there by more than about the root of this number, relative to the
/// level: it was hit by a rare bright path and would alone decide for all pixels around.
inline constexpr float rare_distance = 30;

/// Sums, over the channels of a pixel, the gain of the other picture and its squared distance, both relative to the
/// level. Weights each channel by the pixel's mean colour: an error of 0.01 matters more in a channel of level 0.02
/// than in one of 0.9.
template <class F>
TYNDALL_INLINE void compare_pixels(const FilterView& v, const ChunkOfHalves& q, std::ptrdiff_t at, int x, F level) {
  F gain = F(0.0f), by_noise = F(0.0f), distance = F(0.0f), sum = F(1e-12f);
  for (int output = 0; output < outputs; ++output) sum = sum + max(load<F>(v.filtered[output] + at), F(0.0f));
  const F per_sum = F(3.0f) * level / sum;
  for (int c = 0; c < 3; ++c) {
    const F pa = load<F>(v.filtered[c] + at), pb = load<F>(v.filtered[3 + c] + at);
    const F to_a = pa - load<F>(q.of[c] + x), to_b = pb - load<F>(q.of[3 + c] + x);
    const F residual_a = pa - load<F>(v.half[c] + at), residual_b = pb - load<F>(v.half[3 + c] + at);
    const F own = per_sum * max(pa + pb, F(0.0f));
    const F per = F(1.0f) / mul_add(own, own, splat<F>(v.floor));
    const F cross = mul_add(residual_a, to_b, residual_b * to_a), noise = (pa - pb) * (to_a - to_b);
    gain = mul_add(per, mul_add(F(0.5f), cross, F(0.25f) * noise), gain);
    by_noise = mul_add(F(0.25f) * per, noise, by_noise);
    distance = mul_add(F(0.25f) * per * (to_a + to_b), to_a + to_b, distance);
  }
  const F weight = F(1.0f) / mul_add(distance, splat<F>(1 / rare_distance), F(1.0f));
  store(v.gain + at, weight * gain);
  store(v.distance + at, weight * distance);
  if (v.grouped) store(v.gain_by_noise + at, weight * by_noise);
}

/// Compares the filtered picture with another one, pixel by pixel, in a row.
template <class F>
TYNDALL_INLINE void compare_of(const FilterView& v, Rival rival, int y) {
  ChunkOfHalves q;
  for (int x0 = 0; x0 < v.width; x0 += chunk) {
    const int count = minimum(chunk, v.width - x0);
    take_rival<F>(v, rival, y, x0, count, q);
    for (int x = 0; x < count; x += lanes_of<F>)
      compare_pixels<F>(v, q, y * v.stride + x0 + x, x, level_around<F>(v, y, x0 + x));
  }
  clear_behind(v.gain + y * v.stride, v.width);
  clear_behind(v.distance + y * v.stride, v.width);
  if (v.grouped) clear_behind(v.gain_by_noise + y * v.stride, v.width);
}

/// Number of pixels that decide at (x, y): those of the window inside the picture, without the hole in its middle; lane
/// i is for x + i.
template <int spacing, class F>
TYNDALL_INLINE F deciding_pixels(const FilterView& v, int y, int x) {
  const F last = splat<F>(static_cast<float>(v.width - 1)), at = places<F>(x);
  const bool far_from_sides = x >= window_reach && x + lanes_of<F> + window_reach <= v.width;
  F columns = F(0.0f), rows = F(0.0f);
#pragma GCC unroll 13
  for (int k = -window_reach; k <= window_reach; ++k) {
    if (in_hole<spacing>(k)) continue;
    const F there = at + splat<F>(static_cast<float>(k));
    if (far_from_sides)
      columns = columns + F(1.0f);
    else
      columns = columns + select(mask_or(less(there, F(0.0f)), less(last, there)), F(0.0f), F(1.0f));
    if (y + k >= 0 && y + k < v.height) rows = rows + F(1.0f);
  }
  const F all_columns = covered(at, window_reach, v.width),
          all_rows = covered(splat<F>(static_cast<float>(y)), window_reach, v.height);
  return max(all_rows * columns + rows * (all_columns - columns), F(1.0f));
}

/// Sums over the columns of a window: over all rows, and over the rows outside of a hole. From x0 - row_margin on.
struct ColumnSums {
  alignas(64) float all[chunk + 64], outer[chunk + 64];
};

struct WindowColumns {
  ColumnSums gain, squares, distance;
  ColumnSums by_noise, by_noise_nearby;  ///< only of grouped pixels; the latter's hole is the middle 3 x 3
};

/// Sums the columns of the windows around `count` pixels of row y, from x0 on: of gains, their squares and distances.
template <int spacing, class F>
TYNDALL_INLINE void sum_columns(const FilterView& v, int y, int x0, int count, WindowColumns& columns) {
  for (int x = -row_margin; x < count + window_reach; x += lanes_of<F>) {
    F outer[3] = {F(0.0f), F(0.0f), F(0.0f)}, inner[3] = {F(0.0f), F(0.0f), F(0.0f)};
#pragma GCC unroll 13
    for (int k = -window_reach; k <= window_reach; ++k) {
      if (y + k < 0 || y + k >= v.height) continue;
      F(&sum)[3] = in_hole<spacing>(k) ? inner : outer;
      const std::ptrdiff_t at = (y + k) * v.stride + x0 + x;
      const F gain = load<F>(v.gain + at);
      sum[0] = sum[0] + gain, sum[1] = mul_add(gain, gain, sum[1]), sum[2] = sum[2] + load<F>(v.distance + at);
    }
    fetch(v, v.gain, y + window_reach + 1, x0 + x);
    fetch(v, v.distance, y + window_reach + 1, x0 + x);
    ColumnSums* const sums[] = {&columns.gain, &columns.squares, &columns.distance};
    for (int s = 0; s < 3; ++s) {
      store(sums[s]->all + row_margin + x, outer[s] + inner[s]);
      store(sums[s]->outer + row_margin + x, outer[s]);
    }
  }
}

/// Sums the columns of the part of the gain that is due to noise, with both holes.
template <int spacing, class F>
TYNDALL_INLINE void sum_noise_columns(const FilterView& v, int y, int x0, int count, WindowColumns& columns) {
  for (int x = -row_margin; x < count + window_reach; x += lanes_of<F>) {
    F far = F(0.0f), between = F(0.0f), middle = F(0.0f);
#pragma GCC unroll 13
    for (int k = -window_reach; k <= window_reach; ++k) {
      if (y + k < 0 || y + k >= v.height) continue;
      F& sum = in_hole<0>(k) ? middle : in_hole<spacing>(k) ? between : far;
      sum = sum + load<F>(v.gain_by_noise + (y + k) * v.stride + x0 + x);
    }
    const F nearby = far + between, all = nearby + middle;
    store(columns.by_noise.all + row_margin + x, all), store(columns.by_noise.outer + row_margin + x, far);
    store(columns.by_noise_nearby.all + row_margin + x, all);
    store(columns.by_noise_nearby.outer + row_margin + x, nearby);
  }
}

/// Returns the sum over the window around x, without its hole. The sum is computed anew for each x: a running sum would
/// keep the rounding errors of a bright pixel that has left the window.
template <int spacing, class F>
TYNDALL_INLINE F window_sum(const ColumnSums& columns, int x) {
  const float *all = columns.all + row_margin + x, *outer = columns.outer + row_margin + x;
  F total = F(0.0f);
  for (int k = -window_reach; k <= window_reach; ++k) total = total + load<F>((in_hole<spacing>(k) ? outer : all) + k);
  return total;
}

/// Returns the fraction of the rival in the mixture with the least error, in [0, 1]. doubt: the gain counts only as far
/// as it exceeds this many of its standard errors; 0 for the raw picture, which has no bias in any scene.
///
/// Of grouped pixels, the part of the gain that is due to noise is a mean over all pixels but the middle 3 x 3. If a
/// group of eight pixels has met one rare bright path, the regression has spread its light over the pixels around: for
/// these the raw picture is better, and for the eight it is far worse. Without the eight in this mean, the raw picture
/// would be chosen just there, and show them as a grid of dots. The rest of the gain is a product of independent halves
/// and remains a mean over pixels that share no noise with the middle, as the error estimate requires.
template <int spacing, class F>
TYNDALL_INLINE F fraction_of_rival(const FilterView& v, const WindowColumns& columns, float doubt, int y, int x0,
                                   int x) {
  const F pixels = deciding_pixels<spacing, F>(v, y, x0 + x);
  F gain = window_sum<spacing, F>(columns.gain, x) / pixels;
  const F squares = window_sum<spacing, F>(columns.squares, x) / pixels;
  const F distance = window_sum<spacing, F>(columns.distance, x) / pixels;
  const F error = sqrt(max(neg_mul_add(gain, gain, squares), F(0.0f)) / pixels);
  if constexpr (spacing > 0) {
    const F nearby = window_sum<0, F>(columns.by_noise_nearby, x) / deciding_pixels<0, F>(v, y, x0 + x);
    gain = gain + (nearby - window_sum<spacing, F>(columns.by_noise, x) / pixels);
  }
  const F fraction = neg_mul_add(splat<F>(doubt), error, gain) / max(distance, F(1e-12f));
  return min(max(fraction, F(0.0f)), F(1.0f));
}

/// Mixes another picture into the filtered one, in a row, as far as the pixels around say that it helps.
template <int spacing, class F>
TYNDALL_INLINE void mix_spaced(const FilterView& v, Rival rival, int y) {
  const float doubt = rival == Rival::raw ? 0.0f : 0.5f;
  ChunkOfHalves q;
  WindowColumns columns;
  for (int x0 = 0; x0 < v.width; x0 += chunk) {
    const int count = minimum(chunk, v.width - x0);
    take_rival<F>(v, rival, y, x0, count, q);
    sum_columns<spacing, F>(v, y, x0, count, columns);
    if constexpr (spacing > 0) sum_noise_columns<spacing, F>(v, y, x0, count, columns);
    for (int x = 0; x < count; x += lanes_of<F>) {
      const std::ptrdiff_t at = y * v.stride + x0 + x;
      const F fraction = fraction_of_rival<spacing, F>(v, columns, doubt, y, x0, x);
      F level = F(0.0f);
      for (int output = 0; output < outputs; ++output) {
        const F p = load<F>(v.filtered[output] + at);
        const F mixed = mul_add(fraction, load<F>(q.of[output] + x) - p, p);
        store(v.filtered[output] + at, mixed);
        level = level + mixed;
      }
      store(v.level + at, F(1.0f / outputs) * level);
    }
  }
  clear_behind(v.level + y * v.stride, v.width);
}

template <class F>
TYNDALL_INLINE void mix_of(const FilterView& v, Rival rival, int y) {
  v.grouped ? mix_spaced<group_spacing, F>(v, rival, y) : mix_spaced<0, F>(v, rival, y);
}

}  // namespace tyndall::filter

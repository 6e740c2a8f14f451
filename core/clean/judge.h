#pragma once
#include "core/clean/choice.h"
#include "core/clean/predict.h"

/// Estimates the error of the chosen picture by the formula in choice.h, and lists all steps of the filter.
namespace tyndall::filter {

/// Statistics of one channel, over both halves, in the 3 x 3 pixels around each lane's pixel.
template <class F>
struct Surroundings {
  F others;  ///< mean of the pixels but the middle one
  F noise;   ///< variance of the mean of both halves of a pixel
};

template <class F>
TYNDALL_INLINE Surroundings<F> look_around(const FilterView& v, int channel, int y, int x) {
  F sum = F(0.0f), squares = F(0.0f);
  for (int k = maximum(y - 1, 0); k <= minimum(y + 1, v.height - 1); ++k)
    for (int i = -1; i <= 1; ++i) {
      const std::ptrdiff_t at = k * v.stride + x + i;
      const F a = load<F>(v.half[channel] + at), b = load<F>(v.half[3 + channel] + at);
      sum = sum + (a + b);
      squares = mul_add(a - b, a - b, squares);
    }
  const std::ptrdiff_t at = y * v.stride + x;
  const F pixels = pixels_around<F>(v, y, x, 1),
          own = load<F>(v.half[channel] + at) + load<F>(v.half[3 + channel] + at);
  return {max(F(0.5f) * (sum - own) / max(pixels - F(1.0f), F(1.0f)), F(0.0f)), F(0.25f) * squares / pixels};
}

/// Returns the level to which a pixel's error is relative: the raw mean of the pixels around it, without the pixel
/// itself, because a bright speck measured relative to itself would look like a small error.
///
/// The level is raised towards the pixel's own mean where the pixel is brighter than its neighbours, and more so where
/// its two halves agree. The level is lowered towards the pixel's mean where the pixel is darker than the noise around
/// explains and a feature is seen that is not sharp, for example at the rim of a glass sphere. Elsewhere it is not
/// lowered: pixels that are dark by chance have both halves wrong in the same direction; they would count more than
/// pixels bright by chance and make the error look twice as large.
template <class F>
TYNDALL_INLINE F known_level(const FilterView& v, F a, F b, F sharp, const Surroundings<F>& around) {
  const F both = a + b, apart = F(2.0f) * (a - b);
  const F agreed = max(neg_mul_add(apart, apart, both * both) / max(both * both, F(1e-30f)), F(0.0f));
  const F above = neg_mul_add(F(1.0f), around.others, F(0.5f) * both), square = above * above;
  const F real = max(neg_mul_add(F(5.0f), around.noise, square) / max(square, F(1e-30f)), F(0.0f));
  const F below = select(less(F(0.0f), sharp), F(0.0f), splat<F>(v.trust_in_dark) * real);
  const F fraction = select(less(F(0.0f), above), agreed, below);
  return mul_add(fraction, above, around.others);
}

/// Whether the filter has spread light over a sharp edge into the dark, for example beside a caustic. True if the raw
/// picture is much darker than the filtered one at the pixel and at two or more of its 8 neighbours, and the halves
/// agree about all 9 pixels better than pixels do that are dark by chance. Besides, two neighbours must be brighter
/// than the filtered picture (else dark floors would get holes), unless the halves agree so well that chance is
/// excluded. Always false at the left and right borders, where pixels beside the picture count as unknown.
template <class F>
TYNDALL_INLINE auto glows_into_dark(const FilterView& v, int y, int x) {
  const auto sum = [](const float* const* planes, std::ptrdiff_t at) __attribute__((always_inline)) {
    return load<F>(planes[0] + at) + load<F>(planes[1] + at) + load<F>(planes[2] + at);
  };
  const std::ptrdiff_t at = y * v.stride + x;
  const F raw = sum(v.half, at) + sum(v.half + 3, at), picture = sum(v.filtered, at) + sum(v.filtered + 3, at);
  const F darker = splat<F>(1 / v.by_far) * picture;
  const auto glows = less(raw, darker);
  if (!any(glows)) return glows;
  constexpr float certain = 0.004f;                     // relative variance that only hundreds of samples reach
  F noise = F(0.0f), dark = F(0.0f), bright = F(0.0f);  // noise: relative variance of a pixel's mean, times the pixels
  for (int k = maximum(y - 1, 0); k <= minimum(y + 1, v.height - 1); ++k)
    for (int i = -1; i <= 1; ++i) {
      const std::ptrdiff_t there = k * v.stride + x + i;
      const F a = sum(v.half, there), b = sum(v.half + 3, there), both = a + b;
      const F apart = (a - b) / max(both, F(1e-30f));
      noise = noise + select(less(F(0.0f), both), apart * apart, F(1.0f));
      dark = dark + select(less(both, darker), F(1.0f), F(0.0f));
      bright = bright + select(less(picture, both), F(1.0f), F(0.0f));
    }
  noise = noise / pixels_around<F>(v, y, x, 1);
  const F above = picture - raw;
  const auto known = mask_and(less(noise, splat<F>(v.quiet)), less(F(9.0f) * noise * raw * raw, above * above));
  const auto edge = mask_or(less(F(1.5f), bright), less(noise, F(certain)));
  return mask_and(mask_and(glows, known), mask_and(less(F(2.5f), dark), edge));
}

/// Estimates the error of each pixel of a row, relative to the smaller of the filtered picture and the level known from
/// the raw picture; then replaces bad pixels. A pixel becomes raw where light glows into the dark and where the result
/// is not finite (numbers too large for single precision). Negative results, which a linear function may have beside a
/// bright speck, become 0, which is nearer to the truth; the error stays that of the filter's result.
template <class F>
TYNDALL_INLINE void judge_of(const FilterView& v, int y) {
  for (int x = 0; x < v.width; x += lanes_of<F>) {
    for (int output = 0; output < outputs; ++output)
      fetch(v, v.half[output], y + 2, x), fetch(v, v.filtered[output], y + 1, x);
    const std::ptrdiff_t at = y * v.stride + x;
    const auto raw = glows_into_dark<F>(v, y, x);
    F bias = F(0.0f), noise = F(0.0f);
    for (int c = 0; c < 3; ++c) {
      const F a = load<F>(v.half[c] + at), b = load<F>(v.half[3 + c] + at);
      F pa = load<F>(v.filtered[c] + at), pb = load<F>(v.filtered[3 + c] + at);
      const auto kept = mask_and_not(equal(F(0.0f) * (pa + pb), F(0.0f)), raw);
      pa = select(kept, pa, a), pb = select(kept, pb, b);
      const F picture = max(F(0.5f) * (pa + pb), F(0.0f));
      const F known = known_level(v, a, b, load<F>(v.sharp + at), look_around<F>(v, c, y, x));
      const F level = max(min(picture, known), F(0.0f));
      const F per = F(1.0f / 3.0f) / mul_add(level, level, splat<F>(v.floor));
      bias = mul_add((pa - a) * (pb - b), per, bias);
      noise = mul_add(F(0.25f) * ((pa - pb) * (pa - pb)), per, noise);
      store(v.filtered[c] + at, picture);
      store(v.filtered[3 + c] + at, pb);
    }
    store(v.error + at, bias + noise);
    store(v.noise + at, noise);
  }
  clear_behind(v.error + y * v.stride, v.width);
}

/// Fills in the relative error of each pixel of a row: the root of the mean of view.error over the window around the
/// pixel. A mean that is negative by chance counts as 0.
template <class F>
TYNDALL_INLINE void tell_of(const FilterView& v, int y, float* pixel_error) {
  alignas(64) float column[chunk + 64], root[chunk + 64];  // from x0 - row_margin on; from x0 on
  for (int x0 = 0; x0 < v.width; x0 += chunk) {
    const int count = minimum(chunk, v.width - x0);
    for (int x = -row_margin; x < count + window_reach; x += lanes_of<F>) {
      F sum = F(0.0f);
      for (int k = maximum(y - window_reach, 0); k <= minimum(y + window_reach, v.height - 1); ++k)
        sum = sum + load<F>(v.error + k * v.stride + x0 + x);
      store(column + row_margin + x, sum);
      fetch(v, v.error, y + window_reach + 1, x0 + x);
    }
    for (int x = 0; x < count; x += lanes_of<F>) {
      F sum = F(0.0f);
      for (int k = -window_reach; k <= window_reach; ++k) sum = sum + load<F>(column + row_margin + x + k);
      store(root + x, sqrt(max(sum, F(0.0f)) / pixels_around<F>(v, y, x0 + x, window_reach)));
    }
    __builtin_memcpy(pixel_error + x0, root, static_cast<std::size_t>(count) * sizeof(float));
  }
}

/// The steps over the number type F; a .cpp file for each instruction set asks for them. The functions are within a
/// static one, so that each file has its own copy: of an ordinary template the linker keeps one copy for all files, and
/// a copy with wide instructions would crash older CPUs.
template <class F>
static FilterSteps filter_of() {
  return {[](const FilterView& view, int row) { sum_cells_of<F>(view, row); },
          [](const FilterView& view, int row) { fit_blocks_of<F>(view, row); },
          [](const FilterView& view, int row) { predict_of<F>(view, row); },
          [](const FilterView& view, Rival rival, int y) { compare_of<F>(view, rival, y); },
          [](const FilterView& view, Rival rival, int y) { mix_of<F>(view, rival, y); },
          [](const FilterView& view, int y) { judge_of<F>(view, y); },
          [](const FilterView& view, int y, float* pixel_error) { tell_of<F>(view, y, pixel_error); }};
}

}  // namespace tyndall::filter

#include "core/clean/clean.h"

#include "core/clean/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tyndall_targets.h>

namespace tyndall {

/// One number at a time: the readable reference, for any processor.
template <>
filter::FilterSteps filter::filter_for<Target::scalar>() {
  return filter_of<float>();
}

using namespace filter;
namespace {

/// The column of a term i of a half.
int column_of(int half, int i) { return i < plain_terms ? i : i + half * emission_terms; }

/// The products of columns that cells sum, at the indices that product_sum() and channel_sum() tell.
std::vector<ColumnPair> column_pairs() {
  std::vector<ColumnPair> pairs(all_sums);
  const auto put = [&](int sum, int i, int j) {
    pairs[static_cast<std::size_t>(sum)] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)};
  };
  for (int half = 0; half < 2; ++half)
    for (int i = 0; i < terms; ++i)
      for (int j = 0; j <= i; ++j) put(product_sum(half, i, j), column_of(half, i), column_of(half, j));
  for (int output = 0; output < outputs; ++output)
    for (int i = 0; i < terms; ++i) put(channel_sum(output, i), half_column + output, column_of(output / 3, i));
  for (int k = 0; k < emission_terms; ++k)
    put(emission_cross + k, emission_column + emission_terms + k, emission_column + k);
  return pairs;
}

int cells_in(int pixels) { return (pixels + cell_edge - 1) / cell_edge; }

void put_picture(const FilterView& view, float scale, int y, float* rgb) {
  const float *red = view.filtered[0] + y * view.stride, *green = view.filtered[1] + y * view.stride,
              *blue = view.filtered[2] + y * view.stride;
  for (int x = 0; x < view.width; ++x, rgb += 3)
    rgb[0] = scale * red[x], rgb[1] = scale * green[x], rgb[2] = scale * blue[x];
}

/// Judges one pixel as judge_of() judges a row, but with a known level, in units of the planes. Returns the squared
/// relative error.
double judge_at_level(const FilterView& v, std::size_t pixel, Vec3f level) {
  const auto width = static_cast<std::size_t>(v.width);
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(pixel / width) * v.stride + static_cast<int>(pixel % width);
  const std::array<float, 3> levels{level.x, level.y, level.z};
  float bias = 0, noise = 0;
  for (std::size_t c = 0; c < levels.size(); ++c) {
    const float a = v.half[c][at], b = v.half[3 + c][at], pb = v.filtered[3 + c][at], pa = 2 * v.filtered[c][at] - pb;
    const float per = 1 / (3 * (levels[c] * levels[c] + v.floor));
    bias += (pa - a) * (pb - b) * per;
    noise += (pa - pb) * (pa - pb) / 4 * per;
  }
  v.error[at] = bias + noise, v.noise[at] = noise;
  return static_cast<double>(v.error[at]);
}

/// Resizes in steps small enough to stop soon after `give_up` is set.
void grow(std::vector<float>& numbers, std::size_t count, const std::atomic<bool>& give_up) {
  constexpr std::size_t step = std::size_t{1} << 18u;
  numbers.reserve(count);
  for (std::size_t size = std::min(numbers.size(), count); size < count && !give_up.load(std::memory_order_relaxed);)
    numbers.resize(size = std::min(size + step, count));
  if (numbers.size() > count) numbers.resize(count);
}

/// The errors of the pixels in a band of rows.
ErrorSum errors_in_band(const FilterView& v, int band) {
  ErrorSum sum;
  for (int y = band * cell_edge; y < std::min((band + 1) * cell_edge, v.height); ++y)
    for (int x = 0; x < v.width; ++x)
      sum.add({static_cast<std::size_t>(y) * static_cast<std::size_t>(v.width) + static_cast<std::size_t>(x),
               static_cast<double>(v.error[y * v.stride + x])});
  return sum;
}

}  // namespace

Cleaner::Cleaner(Target target)
    : Cleaner(use_target<TYNDALL_BUILT_TARGETS>(target, [](auto built) { return filter_for<built()>(); })) {}
Cleaner::Cleaner(const FilterSteps& steps) : steps_(steps), pairs_(column_pairs()) {}

void Cleaner::resize(int width, int height, bool grouped) {
  work_.resize(width, height, outputs + (grouped ? 4 : 3));
  if (made_.width != width || made_.height != height) made_ = {};  // its memory would stay that of a larger picture
  row_noise_.resize(static_cast<std::size_t>(height));
  if (cells_x_ == cells_in(width) && cells_y_ == cells_in(height)) return;
  cells_x_ = cells_y_ = 0;  // should there be no memory for the new size
  constexpr int lanes = 16;
  cell_stride_ = std::ptrdiff_t{(cells_in(width) + 2 + 2 * lanes) / lanes} * lanes;
  const auto rows = static_cast<std::size_t>(cells_in(height)) + 2, row = static_cast<std::size_t>(cell_stride_);
  sums_.resize(rows * all_sums * row + row);
  shines_.assign(rows * row + row, 0);
  coefficients_.resize((rows - 1) * outputs * terms * row);
  cells_x_ = cells_in(width), cells_y_ = cells_in(height);
}

FilterView Cleaner::view_of(const CleanInput& input) {
  FilterView v;
  v.width = input.width, v.height = input.height, v.stride = work_.stride();
  v.floor = 0.01f / input.scale / input.scale;
  v.grouped = input.grouped;
  v.trust_in_dark = input.spp >= 16 ? 1.0f : 0.0f;
  const auto doubt = static_cast<float>(1 / std::sqrt(std::max(input.spp, 1.0)));
  v.by_far = std::max(16 * doubt, 2.0f), v.quiet = std::min(0.8f * doubt, 0.4f);
  for (int k = 0; k < outputs; ++k) {
    v.half[k] = input.halves.plane(k), v.filtered[k] = work_.plane(k);
    v.emission[k] = input.emission.count() > 0 ? input.emission.plane(k) : nullptr;
  }
  v.dark_rows = input.dark_rows.empty() ? nullptr : input.dark_rows.data();
  for (int k = 0; k < seen_features; ++k) v.seen[k] = input.seen.plane(k);
  v.sharp = input.seen.plane(seen_features);
  v.level = work_.plane(outputs), v.gain = work_.plane(outputs + 1), v.distance = work_.plane(outputs + 2);
  v.gain_by_noise = v.grouped ? work_.plane(outputs + 3) : nullptr;
  v.error = v.gain, v.noise = v.distance;
  v.pairs = pairs_.data(), v.sums = sums_.data(), v.shines = shines_.data(), v.cell_stride = cell_stride_;
  v.coefficients = coefficients_.data();
  return v;
}

bool Cleaner::run(const CleanInput& input, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanPicture& out,
                  const LevelsOf& levels_of) {
  resize(input.width, input.height, input.grouped);
  const FilterView v = view_of(input);
  const auto each = [&](int rows, const auto& step) {
    thread_pool.for_each(rows, [&](int row) {
      if (!give_up.load(std::memory_order_relaxed)) step(row);
    });
    return !give_up;
  };
  // Rows of pixels are dealt out in bands, so that a thread finds neighbouring rows in its cache.
  const auto each_pixel_row = [&](const auto& step) {
    return each(cells_y_, [&](int band) {
      const int end = std::min((band + 1) * cell_edge, v.height);
      for (int y = band * cell_edge; y < end && !give_up.load(std::memory_order_relaxed); ++y) step(y);
    });
  };
  const auto mix = [&](Rival rival) {
    return each_pixel_row([&](int y) { steps_.compare(v, rival, y); }) &&
           each_pixel_row([&](int y) { steps_.mix(v, rival, y); });
  };
  const auto width = static_cast<std::size_t>(v.width), height = static_cast<std::size_t>(v.height);
  // One thread allocates the result while the others sum, because the system takes time to provide new memory.
  const auto make_room = [&] {
    made_.width = v.width, made_.height = v.height;
    grow(made_.rgb, 3 * width * height, give_up);
    grow(made_.pixel_error, width * height, give_up);
  };
  const auto sum_row = [&](int row) { row == 0 ? make_room() : steps_.sum_cells(v, row - 1); };
  const bool whole = each(cells_y_ + 1, sum_row) && each(cells_y_ + 1, [&](int row) { steps_.fit_blocks(v, row); }) &&
                     each(cells_y_, [&](int row) { steps_.predict(v, row); }) && mix(Rival::blurred) &&
                     mix(Rival::raw) && each_pixel_row([&](int y) { steps_.judge(v, y); });
  std::vector<ErrorSum> bands(static_cast<std::size_t>(cells_y_));
  const auto sum_errors = [&](int band) { bands[static_cast<std::size_t>(band)] = errors_in_band(v, band); };
  if (!whole || !each(cells_y_, sum_errors)) return false;
  ErrorSum errors;
  for (const ErrorSum& band : bands) errors.add(band);
  const auto judge_anew = [&](std::size_t pixel, Vec3f level) {
    return judge_at_level(v, pixel, 1 / input.scale * level);
  };
  if (levels_of) ask_levels(levels_of, width * height, judge_anew, errors);
  const bool copied = each_pixel_row([&](int y) {
    const std::size_t row = static_cast<std::size_t>(y) * width;
    put_picture(v, input.scale, y, made_.rgb.data() + 3 * row);
    steps_.tell(v, y, made_.pixel_error.data() + row);
    const float* noise = v.noise + y * v.stride;
    row_noise_[static_cast<std::size_t>(y)] = std::accumulate(noise, noise + v.width, 0.0);
  });
  if (!copied) return false;
  const double pixels = static_cast<double>(width * height);
  // The errors are noise plus squared bias, and the estimate of the latter may be negative by chance.
  const double error = std::max(errors.sum(), std::accumulate(row_noise_.begin(), row_noise_.end(), 0.0));
  made_.relative_error = std::sqrt(error / pixels);
  // The second term subtracts the spread that small pictures show by chance.
  made_.rests_on_few_pixels = std::sqrt(errors.squares()) - 3 / std::sqrt(pixels) * error > 0.35 * error;
  std::swap(out, made_);
  return true;
}

}  // namespace tyndall

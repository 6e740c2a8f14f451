#include "core/clean/clean.h"

#include "core/clean/filter_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
using namespace filter;
namespace {

static_assert(Planes::margin == row_margin);

constexpr FilterSteps (*filters[target_count])() = {
    scalar_filter,
#if defined(TYNDALL_HAVE_SSE4)
    sse4_filter,
#else
    nullptr,
#endif
#if defined(TYNDALL_HAVE_AVX2)
    avx2_filter,
#else
    nullptr,
#endif
#if defined(TYNDALL_HAVE_AVX512)
    avx512_filter,
#else
    nullptr,
#endif
};

/// The products of columns that cells sum, in the order that product_sum() and channel_sum() expect.
std::vector<ColumnPair> column_pairs() {
  std::vector<ColumnPair> pairs;
  const auto add = [&](int i, int j) { pairs.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)}); };
  for (int i = 0; i < plain_terms; ++i)
    for (int j = 0; j <= i; ++j) add(i, j);
  for (int output = 0; output < outputs; ++output)
    for (int i = 0; i < plain_terms; ++i) add(half_column + output, i);
  for (int half = 0; half < 2; ++half) {
    const int own = emission_column + half * emission_terms;
    for (int k = 0; k < emission_terms; ++k)
      for (int i = 0; i < plain_terms; ++i) add(own + k, i);
    for (int k = 0; k < emission_terms; ++k)
      for (int j = 0; j <= k; ++j) add(own + k, own + j);
    for (int c = 0; c < outputs / 2; ++c)
      for (int k = 0; k < emission_terms; ++k) add(half_column + half * 3 + c, own + k);
  }
  for (int k = 0; k < emission_terms; ++k) add(emission_column + emission_terms + k, emission_column + k);
  assert(pairs.size() == all_sums);
  return pairs;
}

int cells_in(int pixels) { return (pixels + cell_edge - 1) / cell_edge; }

}  // namespace

struct Cleaner::Memory {
  FilterSteps steps;
  std::vector<ColumnPair> pairs = column_pairs();
  Planes work;  ///< filtered 6, level, gain, distance
  CleanPicture made;
  ZeroedFloats sums, coefficients;
  std::vector<std::uint8_t> shines;
  std::vector<double> row_bias, row_noise, row_squares;
  int cells_x = 0, cells_y = 0;
  std::ptrdiff_t cell_stride = 0;

  void resize(int width, int height) {
    work.resize(width, height, outputs + 3);
    for (std::vector<double>* rows : {&row_bias, &row_noise, &row_squares})
      rows->resize(static_cast<std::size_t>(height));
    if (cells_x == cells_in(width) && cells_y == cells_in(height)) return;
    cells_x = cells_in(width), cells_y = cells_in(height);
    constexpr int lanes = 16;
    cell_stride = std::ptrdiff_t{(cells_x + 2 + 2 * lanes) / lanes} * lanes;
    const auto rows = static_cast<std::size_t>(cells_y) + 2, row = static_cast<std::size_t>(cell_stride);
    sums.resize(rows * all_sums * row + row);
    shines.assign(rows * row + row, 0);
    coefficients.resize((rows - 1) * outputs * terms * row);
  }
};

namespace {

/// The relative error of each pixel of a row: the root of the mean of view.error over the 13 x 13 pixels around it. A
/// mean that is negative by chance counts as 0.
void put_pixel_errors(const FilterView& view, int y, float* to) {
  constexpr int reach = 6;
  const int top = std::max(y - reach, 0), bottom = std::min(y + reach, view.height - 1);
  std::vector<float> column(static_cast<std::size_t>(view.width));
  for (int k = top; k <= bottom; ++k)
    for (int x = 0; x < view.width; ++x) column[static_cast<std::size_t>(x)] += view.error[k * view.stride + x];
  for (int x = 0; x < view.width; ++x) {
    const int left = std::max(x - reach, 0), right = std::min(x + reach, view.width - 1);
    float sum = 0;
    for (int k = left; k <= right; ++k) sum += column[static_cast<std::size_t>(k)];
    to[x] = std::sqrt(std::max(sum, 0.0f) / static_cast<float>((right - left + 1) * (bottom - top + 1)));
  }
}

void put_picture(const FilterView& view, float scale, int y, float* rgb) {
  for (int x = 0; x < view.width; ++x)
    for (int c = 0; c < 3; ++c) rgb[3 * x + c] = scale * view.filtered[c][y * view.stride + x];
}

/// Whether few pixels make up most of the sum of all pixels' errors, of whose squares the sum is `squares`. Small
/// pictures show some spread by chance alone: the second term takes off as much.
bool few_matter(double sum, double squares, double pixels) {
  return std::sqrt(squares) - 3 / std::sqrt(pixels) * sum > 0.35 * sum;
}

double sum_of(const std::vector<double>& rows) {
  double sum = 0;
  for (const double row : rows) sum += row;
  return sum;
}

}  // namespace

Cleaner::Cleaner(Target target) : Cleaner(filters[static_cast<int>(target)]()) {}
Cleaner::Cleaner(const FilterSteps& steps) : memory_(std::make_unique<Memory>()) { memory_->steps = steps; }
Cleaner::~Cleaner() = default;
Cleaner::Cleaner(Cleaner&&) noexcept = default;
Cleaner& Cleaner::operator=(Cleaner&&) noexcept = default;

bool Cleaner::run(const CleanInput& input, Crew& crew, const std::atomic<bool>& give_up, CleanPicture& out) {
  Memory& m = *memory_;
  m.resize(input.width, input.height);
  FilterView v;
  v.width = input.width, v.height = input.height, v.stride = m.work.stride();
  v.floor = 0.01f / input.scale / input.scale;
  for (int k = 0; k < outputs; ++k) {
    v.half[k] = input.halves.plane(k), v.filtered[k] = m.work.plane(k);
    v.emission[k] = input.emission.count() > 0 ? input.emission.plane(k) : nullptr;
  }
  for (int k = 0; k < seen_features; ++k) v.seen[k] = input.seen.plane(k);
  v.sharp = input.seen.plane(seen_features);
  v.level = m.work.plane(outputs), v.gain = m.work.plane(outputs + 1), v.distance = m.work.plane(outputs + 2);
  v.error = v.gain;
  v.pairs = m.pairs.data(), v.sums = m.sums.data(), v.shines = m.shines.data(), v.cell_stride = m.cell_stride;
  v.coefficients = m.coefficients.data();
  v.row_bias = m.row_bias.data(), v.row_noise = m.row_noise.data(), v.row_squares = m.row_squares.data();
  const auto each = [&](int rows, const auto& step) {
    crew.for_each(rows, [&](int row) {
      if (!give_up.load(std::memory_order_relaxed)) step(row);
    });
    return !give_up;
  };
  const auto mix = [&](Rival rival) {
    return each(v.height, [&](int y) { m.steps.compare(v, rival, y); }) &&
           each(v.height, [&](int y) { m.steps.mix(v, rival, y); });
  };
  const bool whole = each(m.cells_y, [&](int row) { m.steps.sum_cells(v, row); }) &&
                     each(m.cells_y + 1, [&](int row) { m.steps.fit_blocks(v, row); }) &&
                     each(m.cells_y, [&](int row) { m.steps.predict(v, row); }) && mix(Rival::blurred) &&
                     mix(Rival::raw) && each(v.height, [&](int y) { m.steps.judge(v, y); });
  if (!whole) return false;
  const auto width = static_cast<std::size_t>(v.width), height = static_cast<std::size_t>(v.height);
  m.made.width = v.width, m.made.height = v.height;
  m.made.rgb.resize(3 * width * height);
  m.made.pixel_error.resize(width * height);
  const bool copied = each(v.height, [&](int y) {
    const std::size_t row = static_cast<std::size_t>(y) * width;
    put_picture(v, input.scale, y, m.made.rgb.data() + 3 * row);
    put_pixel_errors(v, y, m.made.pixel_error.data() + row);
  });
  if (!copied) return false;
  const double pixels = static_cast<double>(width * height);
  const double error = std::max(sum_of(m.row_bias), 0.0) + sum_of(m.row_noise);
  m.made.relative_error = std::sqrt(error / pixels);
  m.made.rests_on_few_pixels = few_matter(error, sum_of(m.row_squares), pixels);
  std::swap(out, m.made);
  return true;
}

}  // namespace tyndall

#include "core/clean/clean.h"

#include "core/system/process.h"

#include <algorithm>
#include <new>
#include <numeric>

namespace tyndall {
namespace {

constexpr std::size_t group = 64;

/// Returns the divisor of all numbers, so that their squares, summed over windows, fit into single precision: 1 unless
/// a light is brighter than 2^25.
float scale_of(const Film& film) { return static_cast<float>(std::max(film.quantum * 0x1p-25, 1.0)); }

/// Returns the number of samples in the row.
std::uint64_t read_row(const Film& film, int y, CleanInput& input) {
  const auto width = static_cast<std::size_t>(input.width);
  const FilmPixel* pixels = film.pixels.data() + static_cast<std::size_t>(y) * width;
  const std::ptrdiff_t row = y * input.halves.stride();
  float* to[filter::outputs];
  for (int k = 0; k < filter::outputs; ++k) to[k] = input.halves.plane(k) + row;
  std::uint64_t samples = 0;
  const double quantum = film.quantum / static_cast<double>(input.scale);
  // The factors from the sums of a half to its means in the planes, 0 for a half without samples. The last ones are
  // kept: most pixels have as many samples as the one before, and the division would take longer than everything else.
  std::uint32_t counts[2] = {};
  double per[2] = {};
  for (std::size_t x = 0; x < width; ++x) {
    const FilmPixel& pixel = pixels[x];
    samples += pixel.taken;
    for (int half = 0; half < 2; ++half)
      if (const std::uint32_t count = counted(film, pixel, half); count != counts[half])
        counts[half] = count, per[half] = count > 0 ? quantum / count : 0;
    for (int half = 0; half < 2; ++half) {
      const int from = per[half] > 0 ? half : 1 - half;
      for (int c = 0; c < 3; ++c) to[3 * half + c][x] = static_cast<float>(pixel.sum[from][c].value() * per[from]);
    }
  }
  return samples;
}

bool is_dark(const EmissionSums& sums) {
  const auto& sum = sums.sum;
  return (sum[0][0] | sum[0][1] | sum[0][2] | sum[1][0] | sum[1][1] | sum[1][2]) == 0;
}

/// Does not write dark rows (most rows) that are 0 already: memory that is never touched costs no time.
void read_emission_row(const Film& film, int y, CleanInput& input) {
  const auto width = static_cast<std::size_t>(input.width), first = static_cast<std::size_t>(y) * width;
  const EmissionSums* sums = film.emission.data() + first;
  std::uint8_t& is_row_dark = input.dark_rows[static_cast<std::size_t>(y)];
  const bool dark = std::all_of(sums, sums + width, is_dark);
  if (dark && is_row_dark != 0) return;
  is_row_dark = dark ? 1 : 0;
  float* to[2 * filter::emission_terms];
  for (int k = 0; k < 2 * filter::emission_terms; ++k) to[k] = input.emission.plane(k) + y * input.emission.stride();
  for (std::size_t x = 0; x < width; ++x)
    for (int half = 0; half < 2; ++half) {
      const Vec3f mean = is_dark(sums[x]) ? Vec3f{} : (1 / input.scale) * half_emission(film, first + x, half);
      float* const* plane = to + std::ptrdiff_t{3} * half;
      plane[0][x] = mean.x, plane[1][x] = mean.y, plane[2][x] = mean.z;
    }
}

}  // namespace

void ZeroedFloats::resize(std::size_t count) {
  memory_.reset();
  first_ = nullptr;
  std::size_t bytes = count * sizeof(float) + group;
  memory_.reset(static_cast<float*>(std::calloc(bytes, 1)));
  if (!memory_) throw std::bad_alloc();
  void* begin = memory_.get();
  first_ = static_cast<float*>(std::align(group, bytes - group, begin, bytes));
  if (std::align(large_page, large_page, begin, bytes)) ask_for_large_pages(begin, bytes);
}

bool Planes::resize(int width, int height, int count) {
  if (width == width_ && height == height_ && count == count_) return false;
  width_ = height_ = count_ = 0;  // should there be no memory for the new size
  stride_ = (std::ptrdiff_t{width} + margin - 1) / margin * margin + std::ptrdiff_t{3} * margin;
  data_.resize(static_cast<std::size_t>(stride_ * height * count) + std::size_t{2} * margin);
  width_ = width, height_ = height, count_ = count;
  return true;
}

bool read_film(const Film& film, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanInput& input) {
  input.width = film.region.width(), input.height = film.region.height();
  input.scale = scale_of(film);
  input.halves.resize(input.width, input.height, filter::outputs);
  const auto rows = static_cast<std::size_t>(input.height);
  input.dark_rows.reserve(rows);
  if (input.emission.resize(input.width, input.height, film.emission.empty() ? 0 : 2 * filter::emission_terms))
    input.dark_rows.assign(rows, 1);
  std::vector<std::uint64_t> samples(rows);
  thread_pool.for_each(input.height, [&](int y) {
    if (give_up.load(std::memory_order_relaxed)) return;
    samples[static_cast<std::size_t>(y)] = read_row(film, y, input);
    if (!film.emission.empty()) read_emission_row(film, y, input);
  });
  const auto all = std::accumulate(samples.begin(), samples.end(), std::uint64_t{0});
  input.spp = static_cast<double>(all) / static_cast<double>(film.pixels.size());
  return !give_up;
}

}  // namespace tyndall

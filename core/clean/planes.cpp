#include "core/clean/clean.h"

#include "core/clean/filter_view.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

void Planes::resize(int width, int height, int count) {
  if (width == width_ && height == height_ && count == count_) return;
  width_ = width, height_ = height, count_ = count;
  stride_ = (std::ptrdiff_t{width} + margin - 1) / margin * margin + std::ptrdiff_t{3} * margin;
  data_.assign(static_cast<std::size_t>(stride_ * height * count) + std::size_t{2} * margin, 0.0f);
}

namespace {

/// Numbers are divided by this so that their squares, summed over windows, fit into single precision. It is 1 unless a
/// lamp is brighter than 2^25.
float scale_of(const Film& film) { return static_cast<float>(std::max(film.unit * 0x1p-25, 1.0)); }

/// The factor that turns a half's sums into the means that planes hold; 0 for an empty half.
double per_sample(const Film& film, const FilmPixel& pixel, int half, double scale) {
  const std::uint32_t count = counted(film, pixel, half);
  return count > 0 ? film.unit / scale / count : 0;
}

void read_row(const Film& film, int y, CleanInput& input) {
  const double scale = static_cast<double>(input.scale);
  const auto width = static_cast<std::size_t>(input.width);
  const FilmPixel* pixels = film.pixels.data() + static_cast<std::size_t>(y) * width;
  const std::ptrdiff_t row = y * input.halves.stride();
  float* to[filter::outputs];
  for (int k = 0; k < filter::outputs; ++k) to[k] = input.halves.plane(k) + row;
  for (std::size_t x = 0; x < width; ++x) {
    const FilmPixel& pixel = pixels[x];
    double per[2] = {per_sample(film, pixel, 0, scale), per_sample(film, pixel, 1, scale)};
    for (int half = 0; half < 2; ++half) {
      const int from = per[half] > 0 ? half : 1 - half;
      for (int c = 0; c < 3; ++c) to[3 * half + c][x] = static_cast<float>(pixel.sum[from][c].value() * per[from]);
    }
  }
}

void read_emission_row(const Film& film, int y, CleanInput& input) {
  for (int x = 0; x < input.width; ++x)
    for (int half = 0; half < 2; ++half) {
      const std::size_t pixel = film.index(film.region.x0 + x, film.region.y0 + y);
      const Vec3f mean = (1 / input.scale) * half_emission(film, pixel, half);
      const std::ptrdiff_t at = y * input.emission.stride() + x;
      input.emission.plane(3 * half)[at] = mean.x;
      input.emission.plane(3 * half + 1)[at] = mean.y;
      input.emission.plane(3 * half + 2)[at] = mean.z;
    }
}

/// Of the pixels of a row where anything is seen: how many there are, and the sum of 1 / depth.
struct NearnessOfRow {
  double sum = 0;
  int pixels = 0;
};

NearnessOfRow nearness_of(const FirstSeen* row, int width) {
  NearnessOfRow near;
  for (int x = 0; x < width; ++x)
    if (row[x].depth > 0) near.sum += 1 / static_cast<double>(row[x].depth), ++near.pixels;
  return near;
}

void put_first_seen(const FirstSeen* row, int y, float per_depth, CleanInput& input) {
  for (int x = 0; x < input.seen.width(); ++x) {
    const FirstSeen& p = row[x];
    const bool seen = p.depth > 0;
    const float values[filter::seen_features] = {
        p.albedo.x, p.albedo.y, p.albedo.z, p.normal.x, p.normal.y, p.normal.z, 1 / (1 + p.depth * per_depth)};
    const std::ptrdiff_t at = y * input.seen.stride() + x;
    for (int k = 0; k < filter::seen_features; ++k) input.seen.plane(k)[at] = seen ? values[k] : 0;
    input.seen.plane(filter::seen_features)[at] = seen && !p.sharp ? 0.0f : 1.0f;
  }
}

}  // namespace

bool read_film(const Film& film, Crew& crew, const std::atomic<bool>& give_up, CleanInput& input) {
  input.width = film.region.width(), input.height = film.region.height();
  input.scale = scale_of(film);
  input.halves.resize(input.width, input.height, filter::outputs);
  input.emission.resize(input.width, input.height, film.emission.empty() ? 0 : 2 * filter::emission_terms);
  crew.for_each(input.height, [&](int y) {
    if (give_up.load(std::memory_order_relaxed)) return;
    read_row(film, y, input);
    if (!film.emission.empty()) read_emission_row(film, y, input);
  });
  return !give_up;
}

bool read_first_seen(const std::vector<FirstSeen>& pixels, int width, int height, Crew& crew,
                     const std::atomic<bool>& give_up, CleanInput& input) {
  input.seen.resize(width, height, filter::seen_features + 1);
  std::vector<NearnessOfRow> rows(static_cast<std::size_t>(height));
  const auto row = [&](int y) { return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); };
  crew.for_each(height, [&](int y) {
    if (!give_up.load(std::memory_order_relaxed)) rows[static_cast<std::size_t>(y)] = nearness_of(row(y), width);
  });
  NearnessOfRow all;
  for (const NearnessOfRow& of : rows) all.sum += of.sum, all.pixels += of.pixels;
  const auto per_depth = static_cast<float>(all.pixels > 0 ? all.sum / all.pixels : 1);
  crew.for_each(height, [&](int y) {
    if (!give_up.load(std::memory_order_relaxed)) put_first_seen(row(y), y, per_depth, input);
  });
  return !give_up;
}

}  // namespace tyndall

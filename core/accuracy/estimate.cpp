#include "core/accuracy/estimate.h"

#include "core/accuracy/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace tyndall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float tiny = std::numeric_limits<float>::min();
constexpr int reach = 2;               // pixels to each side that are used for a pixel's level
constexpr int window = 2 * reach + 1;  // edge of the square of these pixels
constexpr int band_rows = 32;          // rows that a thread processes at a time

constexpr float largest = 1e30f;  // squared errors are cut at this, because an infinite one means an empty half

/// Planes of numbers for the pixels of a row, in quanta of the film, with `reach` zeros on both sides. For each
/// channel: its mean m, its squared error n, the product of its halves, and the lesser half; and one plane that counts
/// the pixel. All are 0 where a half is empty. All but the lesser halves are summed over windows. Single precision is
/// enough: its error in s is small against mu², so that g hardly changes.
struct Row {
  static constexpr std::size_t means = 0, noises = 3, products = 6, counts = 9, summed = 10, minimum = 10, planes = 13;
  std::array<std::vector<float>, planes> of;
  explicit Row(int width) {
    for (auto& plane : of) plane.resize(static_cast<std::size_t>(width) + std::size_t(2) * reach);
  }
  /// The number of the first pixel.
  float* plane(std::size_t i) { return of[i].data() + reach; }
  const float* plane(std::size_t i) const { return of[i].data() + reach; }
};

void read_row(const Film& film, int row, Row& to) {
  const auto width = static_cast<std::size_t>(film.region.width());
  const FilmPixel* pixels = film.pixels.data() + static_cast<std::size_t>(row) * width;
  std::array<float*, Row::planes> planes{};
  for (std::size_t i = 0; i < Row::planes; ++i) planes[i] = to.plane(i);
  for (std::size_t x = 0; x < width; ++x) {
    const FilmPixel& pixel = pixels[x];
    const double count_a = counted(film, pixel, 0), count_b = counted(film, pixel, 1);
    const bool whole = count_a > 0 && count_b > 0;
    const double per_a = whole ? 1 / count_a : 0, per_b = whole ? 1 / count_b : 0,
                 fraction_a = whole ? count_a / (count_a + count_b) : 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double a = pixel.sum[0][channel].value() * per_a, b = pixel.sum[1][channel].value() * per_b;
      planes[Row::means + channel][x] = static_cast<float>(b + fraction_a * (a - b));
      planes[Row::noises + channel][x] = static_cast<float>((a - b) * (a - b) / 4);
      planes[Row::products + channel][x] = static_cast<float>(a * b);
      planes[Row::minimum + channel][x] = static_cast<float>(std::min(a, b));
    }
    planes[Row::counts][x] = whole ? 1.0f : 0.0f;
  }
}

/// Sums over the window around each pixel of the middle row, without the pixel itself. The pixel is left out from the
/// start and not subtracted at the end, because the rounding error of a bright pixel would remain. columns: memory for
/// the sums of columns without the middle.
void sum_around(const std::array<const Row*, window>& rows, Row& columns, Row& sums) {
  static_assert(reach == 2);
  for (std::size_t plane = 0; plane < Row::summed; ++plane) {
    const float *up2 = rows[0]->of[plane].data(), *up = rows[1]->of[plane].data(), *own = rows[2]->of[plane].data(),
                *down = rows[3]->of[plane].data(), *down2 = rows[4]->of[plane].data();
    float* __restrict column = columns.of[plane].data();
    float* __restrict sum = sums.of[plane].data();
    const std::size_t size = columns.of[plane].size();
    for (std::size_t i = 0; i < size; ++i) column[i] = (up2[i] + up[i]) + (down[i] + down2[i]);
    for (std::size_t i = 2; i < size - 2; ++i) {
      const float left = (column[i - 2] + own[i - 2]) + (column[i - 1] + own[i - 1]);
      const float right = (column[i + 1] + own[i + 1]) + (column[i + 2] + own[i + 2]);
      sum[i] = column[i] + (left + right);
    }
  }
}

/// Squared relative errors of the pixels of a row.
struct RowErrors {
  std::vector<float> freed;  ///< n / (g² + 0.01)
  std::vector<float> own;    ///< n / (m² + 0.01), with the pixel's own mean
};

/// Adds the errors of a channel. sums: over the pixels around each pixel. floor: 0.01 in squared quanta of the film.
/// This and the next function are separate because compilers do not vectorise both in one loop.
void add_freed_errors(const Row& row, const Row& sums, std::size_t channel, float floor, RowErrors& errors) {
  const float *own_m = row.plane(Row::means + channel), *own_n = row.plane(Row::noises + channel),
              *own_min = row.plane(Row::minimum + channel), *sum_m = sums.plane(Row::means + channel),
              *sum_n = sums.plane(Row::noises + channel), *sum_ab = sums.plane(Row::products + channel),
              *counts = sums.plane(Row::counts);
  float* __restrict freed = errors.freed.data();
  const std::size_t width = errors.freed.size();
  for (std::size_t x = 0; x < width; ++x) {
    const float m = own_m[x], n = own_n[x], per = 1 / std::max(counts[x], 1.0f);
    const float mu = sum_m[x] * per, noise = std::max(n, sum_n[x] * per);
    const float s = std::max(sum_ab[x] * per - mu * mu, 0.0f);
    const float alike = noise / std::max(s + noise, tiny), doubt = 4 * n / std::max(m * m, tiny);
    const float drawn = std::min(std::min(alike, doubt), counts[x]);  // 1 - w; 0 where there are no pixels around
    const float g = std::max(m + drawn * (mu - m), own_min[x]);
    freed[x] += std::min(n / (g * g + floor), largest);
  }
}

void add_own_errors(const Row& row, std::size_t channel, float floor, RowErrors& errors) {
  const float *m = row.plane(Row::means + channel), *n = row.plane(Row::noises + channel);
  float* __restrict own = errors.own.data();
  const std::size_t width = errors.own.size();
  for (std::size_t x = 0; x < width; ++x) own[x] += std::min(n[x] / (m[x] * m[x] + floor), largest);
}

/// Computes the squared relative errors of the middle row.
void find_errors(const std::array<const Row*, window>& rows, float floor, Row& columns, Row& sums, RowErrors& errors) {
  sum_around(rows, columns, sums);
  std::fill(errors.freed.begin(), errors.freed.end(), 0.0f);
  std::fill(errors.own.begin(), errors.own.end(), 0.0f);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    add_freed_errors(*rows[reach], sums, channel, floor, errors);
    add_own_errors(*rows[reach], channel, floor, errors);
  }
  const float* counts = rows[reach]->plane(Row::counts);
  for (std::size_t x = 0; x < errors.own.size(); ++x) {
    const bool whole = counts[x] > 0;
    errors.freed[x] = whole ? errors.freed[x] / 3 : infinity;
    errors.own[x] = whole ? errors.own[x] / 3 : infinity;
  }
}

int bands_of(const Film& film) { return (film.region.height() + band_rows - 1) / band_rows; }

/// Calls use(y, errors of the row y of the region) for all rows. Threads share bands of rows; without threads the
/// caller's does all.
template <class Use>
void for_rows(const Film& film, ThreadPool* thread_pool, const Use& use) {
  const int width = film.region.width(), height = film.region.height();
  const auto floor = std::max(static_cast<float>(floor_of_square / film.quantum / film.quantum), tiny);
  const Row empty(width);
  const std::vector<float> zeros(static_cast<std::size_t>(width));
  const auto is_there = [height](int y) { return y >= 0 && y < height; };
  const auto do_band = [&](int band) {
    const int first = band * band_rows, last = std::min(first + band_rows, height);
    Row columns(width), sums(width);
    std::vector<Row> ring(window, empty);
    RowErrors errors{zeros, zeros};
    const auto in_ring = [&](int y) -> Row& { return ring[static_cast<std::size_t>((y + window) % window)]; };
    for (int y = first - reach; y < last + reach; ++y) {
      if (is_there(y)) read_row(film, y, in_ring(y));
      const int middle = y - reach;
      if (middle < first) continue;
      std::array<const Row*, window> rows{};
      for (int i = 0; i < window; ++i) {
        const int at = middle + i - reach;
        rows[static_cast<std::size_t>(i)] = is_there(at) ? &in_ring(at) : &empty;
      }
      find_errors(rows, floor, columns, sums, errors);
      use(middle, errors);
    }
  };
  if (thread_pool) return thread_pool->for_each(bands_of(film), do_band);
  for (int band = 0; band < bands_of(film); ++band) do_band(band);
}

/// The squared relative errors of pixels, and their sum if levels are the pixels' own means.
struct Spread {
  ErrorSum freed;
  double own = 0;
};

/// left_out: indices of pixels, in ascending order.
Spread spread_of(const Film& film, ThreadPool* thread_pool, const std::vector<std::size_t>& left_out) {
  std::vector<Spread> bands(static_cast<std::size_t>(bands_of(film)));
  const auto width = static_cast<std::size_t>(film.region.width());
  for_rows(film, thread_pool, [&](int y, const RowErrors& errors) {
    Spread& to = bands[static_cast<std::size_t>(y / band_rows)];
    const std::size_t first = static_cast<std::size_t>(y) * width;
    auto next = std::lower_bound(left_out.begin(), left_out.end(), first);
    for (std::size_t x = 0; x < width; ++x)
      if (next != left_out.end() && *next == first + x)
        ++next;
      else
        to.freed.add({first + x, errors.freed[x]}), to.own += static_cast<double>(errors.own[x]);
  });
  Spread all;
  for (const Spread& band : bands) all.freed.add(band.freed), all.own += band.own;
  return all;
}

/// The mean over the channels of d² / (g² + 0.01), where g is the level of a pixel.
double relative_square(Vec3f d, Vec3f level) {
  const auto of_channel = [](float x, float g) {
    const auto value = static_cast<double>(x), at = static_cast<double>(g);
    return std::min(value * value / (at * at + floor_of_square), double{largest});
  };
  return (of_channel(d.x, level.x) + of_channel(d.y, level.y) + of_channel(d.z, level.z)) / 3;
}

/// The true squared relative error of a pixel of known level.
double error_at_level(const Film& film, std::size_t pixel, Vec3f level) {
  return relative_square(mean(film, film.pixels[pixel]) - level, level);
}

/// See ErrorEstimate.
bool few_matter(const Spread& all, double pixels) {
  constexpr double few = 0.35, fewer = 0.22, hidden = 0.36;
  // Small pictures show some spread by chance alone; the second term subtracts that much.
  const double sum = all.freed.sum(), spread = std::sqrt(all.freed.squares()) - 3 / std::sqrt(pixels) * sum;
  return spread > few * sum || (spread > fewer * sum && all.own < hidden * sum);
}

/// Whether no light was found yet although the scene has lights. Films record emission only if there are lights.
bool awaits_light(const Film& film) {
  const auto is_black = [](const FilmPixel& pixel) {
    return std::all_of(std::begin(pixel.sum), std::end(pixel.sum), [](const auto& half) {
      return std::all_of(std::begin(half), std::end(half), [](const auto& sum) { return sum.value() == 0; });
    });
  };
  return !film.emission.empty() && std::all_of(film.pixels.begin(), film.pixels.end(), is_black);
}

}  // namespace

ErrorEstimate estimate_error(const Film& film, ThreadPool* thread_pool, const LevelsOf& levels_of,
                             const std::vector<std::size_t>& rare) {
  if (film.pixels.empty()) return {};
  const Spread plain = spread_of(film, thread_pool, {});
  if (plain.freed.sum() == infinity) return {};
  const auto pixels = static_cast<double>(film.pixels.size());
  const auto ask = [&](const auto& error_at, Spread all) {
    if (levels_of) ask_levels(levels_of, film.pixels.size(), error_at, all.freed);
    return all;
  };
  const auto noise_at = [&](std::size_t pixel, Vec3f level) {  // estimated from the two halves
    const FilmPixel& of = film.pixels[pixel];
    return relative_square(0.5f * (half_mean(film, of, 0) - half_mean(film, of, 1)), level);
  };
  const Spread by_noise = ask(noise_at, plain);
  ErrorEstimate estimate{std::sqrt(by_noise.freed.sum() / pixels),
                         few_matter(by_noise, pixels) || (by_noise.freed.sum() == 0 && awaits_light(film))};
  const std::vector<Vec3f> levels = rare.empty() || !levels_of ? std::vector<Vec3f>() : levels_of(rare);
  if (levels.empty()) return estimate;
  Spread others = spread_of(film, thread_pool, rare);
  for (std::size_t i = 0; i < rare.size(); ++i) {
    const double error = error_at_level(film, rare[i], levels[i]);
    others.freed.add({rare[i], error}), others.own += error;
  }
  const auto error_at = [&](std::size_t pixel, Vec3f level) {
    const bool is_rare = std::binary_search(rare.begin(), rare.end(), pixel);
    return is_rare ? error_at_level(film, pixel, level) : noise_at(pixel, level);
  };
  const Spread known = ask(error_at, std::move(others));
  estimate.relative_error = std::sqrt(known.freed.sum() / pixels);
  estimate.rests_on_few_pixels = estimate.rests_on_few_pixels || few_matter(known, pixels);
  return estimate;
}

std::vector<double> squared_relative_errors(const Film& film, ThreadPool* thread_pool) {
  std::vector<double> all(film.pixels.size());
  const auto width = static_cast<std::size_t>(film.region.width());
  for_rows(film, thread_pool, [&](int y, const RowErrors& errors) {
    std::copy(errors.freed.begin(), errors.freed.end(), all.data() + static_cast<std::size_t>(y) * width);
  });
  return all;
}

std::vector<float> pixel_relative_error(const Film& film, ThreadPool* thread_pool) {
  return root_window_means(squared_relative_errors(film, thread_pool), film.region.width(), film.region.height());
}

bool has_rare_bright_paths(const ErrorEstimate& estimate, std::uint32_t spp, double chance) {
  if (spp < min_rare_spp) return false;
  // chance · spp: mean number of paths a pixel that have met such light. Measured: from half a path on, the estimate is
  // within a fifth of the true error.
  return chance * spp < 0.5 || estimate.rests_on_few_pixels;
}

}  // namespace tyndall

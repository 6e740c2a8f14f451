#include "core/accuracy/error.h"

#include "core/image/tonemap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace tyndall {

namespace {

constexpr double floor_of_square = 0.01;  // keeps black pixels from dominating
constexpr double infinity = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }

}  // namespace

double squared_relative_error(const Film& film, const FilmPixel& pixel) {
  const double count_a = counted(film, pixel, 0), count_b = counted(film, pixel, 1);
  if (count_a == 0 || count_b == 0) return infinity;
  const double per_a = film.unit / count_a, per_b = film.unit / count_b, per_both = film.unit / (count_a + count_b);
  double sum = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double a = pixel.sum[0][channel].value(), b = pixel.sum[1][channel].value();
    sum += square((a * per_a - b * per_b) / 2) / (square((a + b) * per_both) + floor_of_square);
  }
  return sum / 3;
}

double estimated_relative_error(const Film& film, Crew* crew) {
  const std::size_t width = static_cast<std::size_t>(film.region.width());
  std::vector<double> rows(static_cast<std::size_t>(film.region.height()));
  const auto add_row = [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x) rows[row] += squared_relative_error(film, film.pixels[row * width + x]);
  };
  if (crew)
    crew->for_each(film.region.height(), add_row);
  else
    for (int y = 0; y < film.region.height(); ++y) add_row(y);
  if (film.pixels.empty()) return infinity;
  return std::sqrt(std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(film.pixels.size()));
}

namespace {

/// Sums of errors, each against the mean around its pixel, and of their squares.
struct Spread {
  double sum = 0, squares = 0;
};

constexpr int block_edge = 8;

void add_block(const Film& film, const Region& block, Spread& to) {
  double own[block_edge * block_edge][3], apart[block_edge * block_edge][3], around[3] = {};
  int count = 0;
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) {
      const FilmPixel& pixel = film.at(x, y);
      const double count_a = counted(film, pixel, 0), count_b = counted(film, pixel, 1);
      if (count_a == 0 || count_b == 0) continue;
      for (int k = 0; k < 3; ++k) {
        const double a = pixel.sum[0][k].value(), b = pixel.sum[1][k].value();
        own[count][k] = (a + b) * film.unit / (count_a + count_b);
        apart[count][k] = (a / count_a - b / count_b) * film.unit;
        around[k] += own[count][k];
      }
      ++count;
    }
  for (int i = 0; i < count; ++i) {
    double error = 0;
    for (int k = 0; k < 3; ++k) {
      const double others = (around[k] - own[i][k]) / std::max(count - 1, 1);
      error += square(apart[i][k] / 2) / (square(std::min(own[i][k], others)) + floor_of_square);
    }
    to.sum += error, to.squares += square(error);
  }
}

}  // namespace

bool rests_on_few_pixels(const Film& film, Crew* crew) {
  const Region& r = film.region;
  std::vector<Spread> bands(static_cast<std::size_t>((r.height() + block_edge - 1) / block_edge));
  const auto add_band = [&](int band) {
    const int y = r.y0 + band * block_edge;
    for (int x = r.x0; x < r.x1; x += block_edge)
      add_block(film, {x, y, std::min(x + block_edge, r.x1), std::min(y + block_edge, r.y1)},
                bands[static_cast<std::size_t>(band)]);
  };
  const int count = static_cast<int>(bands.size());
  if (crew)
    crew->for_each(count, add_band);
  else
    for (int band = 0; band < count; ++band) add_band(band);
  Spread all;
  for (const Spread& band : bands) all.sum += band.sum, all.squares += band.squares;
  const double few =
      0.35 + 3 / std::sqrt(static_cast<double>(film.pixels.size()));  // small pictures vary by themselves
  return std::sqrt(all.squares) > few * all.sum;
}

FilmMean film_mean(const Film& film) {
  const auto grey = [](Vec3f v) {
    return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3;
  };
  double sum = 0, variance = 0;
  for (const FilmPixel& pixel : film.pixels) {
    const bool whole = counted(film, pixel, 0) > 0 && counted(film, pixel, 1) > 0;
    sum += grey(mean(film, pixel));
    variance += whole ? square((grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1))) / 2) : infinity;
  }
  const auto pixels = static_cast<double>(film.pixels.size());
  return {sum / pixels, std::sqrt(variance) / pixels};
}

namespace {

struct Sum {
  double value = 0;
  int count = 0;
};

/// Replaces each of `count` numbers, `stride` apart, by the sum over itself and its neighbours up to `reach` away.
void sum_window(Sum* numbers, int count, std::size_t stride, int reach, std::vector<Sum>& row) {
  row.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) row[static_cast<std::size_t>(i)] = numbers[static_cast<std::size_t>(i) * stride];
  for (int i = 0; i < count; ++i) {
    Sum sum;
    for (int j = std::max(i - reach, 0); j <= std::min(i + reach, count - 1); ++j) {
      sum.value += row[static_cast<std::size_t>(j)].value;
      sum.count += row[static_cast<std::size_t>(j)].count;
    }
    numbers[static_cast<std::size_t>(i) * stride] = sum;
  }
}

/// For each pixel the root of the mean over the 7 x 7 pixels around it, less those that are infinite.
std::vector<float> root_window_means(const std::vector<double>& squares, int width, int height) {
  constexpr int reach = 3;
  std::vector<Sum> sums, row;
  sums.reserve(squares.size());
  for (const double error : squares) sums.push_back(error == infinity ? Sum{} : Sum{error, 1});
  const auto stride = static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) sum_window(&sums[static_cast<std::size_t>(y) * stride], width, 1, reach, row);
  for (int x = 0; x < width; ++x) sum_window(&sums[static_cast<std::size_t>(x)], height, stride, reach, row);
  std::vector<float> errors;
  errors.reserve(sums.size());
  for (const Sum& sum : sums) {
    errors.push_back(static_cast<float>(sum.count == 0 ? infinity : std::sqrt(sum.value / sum.count)));
  }
  return errors;
}

/// (x - ref)² / (ref² + 0.01): relMSE is its mean.
double squared_error(float image, float reference) {
  const double x = static_cast<double>(image), ref = static_cast<double>(reference);
  return square(x - ref) / (square(ref) + floor_of_square);
}

}  // namespace

std::vector<float> pixel_relative_error(const Film& film) {
  std::vector<double> squares;
  squares.reserve(film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) squares.push_back(squared_relative_error(film, pixel));
  return root_window_means(squares, film.region.width(), film.region.height());
}

std::vector<float> pixel_relative_error(const std::vector<float>& image, const std::vector<float>& reference, int width,
                                        int height) {
  assert(image.size() == reference.size());
  assert(image.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<double> squares;
  squares.reserve(image.size() / 3);
  for (std::size_t i = 0; i < image.size(); i += 3) {
    double sum = 0;
    for (std::size_t k = i; k < i + 3; ++k) sum += squared_error(image[k], reference[k]);
    squares.push_back(sum / 3);
  }
  return root_window_means(squares, width, height);
}

double relative_mse(const std::vector<float>& image, const std::vector<float>& reference) {
  assert(!image.empty() && image.size() == reference.size());
  double sum = 0;
  for (std::size_t i = 0; i < image.size(); ++i) sum += squared_error(image[i], reference[i]);
  return sum / static_cast<double>(image.size());
}

namespace {

/// sRGB of a value clipped to [0, 1]; what is not a number stays so.
double displayed(float linear) {
  if (linear < 0) return 0;
  return static_cast<double>(srgb_encode(linear > 1 ? 1.0f : linear));
}

}  // namespace

ImageError image_error(const std::vector<float>& image, const std::vector<float>& reference) {
  assert(!image.empty() && image.size() == reference.size() && image.size() % 3 == 0);
  ImageError error;
  std::array<double, 3> sum_image{}, sum_reference{};
  double displayed_mse = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double x = static_cast<double>(image[i]), ref = static_cast<double>(reference[i]);
    error.mse += square(x - ref);
    error.rel_mse += squared_error(image[i], reference[i]);
    displayed_mse += square(displayed(image[i]) - displayed(reference[i]));
    sum_image[i % 3] += x;
    sum_reference[i % 3] += ref;
  }
  const double count = static_cast<double>(image.size());
  const auto mean_of = [count](const std::array<double, 3>& sum) {
    return (3 / count) * Vec3d{sum[0], sum[1], sum[2]};
  };
  error.mse /= count;
  error.rmse = std::sqrt(error.mse);
  error.rel_mse /= count;
  error.psnr = -10 * std::log10(displayed_mse / count);
  error.mean_image = mean_of(sum_image);
  error.mean_reference = mean_of(sum_reference);
  return error;
}

}  // namespace tyndall

#include "core/accuracy/error.h"

#include "core/accuracy/relative.h"
#include "core/film/groups.h"
#include "core/image/tonemap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }

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

/// (x - ref)² / (ref² + 0.01): relMSE is its mean.
double squared_error(float image, float reference) {
  const double x = static_cast<double>(image), ref = static_cast<double>(reference);
  return square(x - ref) / (square(ref) + floor_of_square);
}

/// sRGB of a value clipped to [0, 1]; not a number stays not a number.
double displayed(float linear) {
  if (linear < 0) return 0;
  return static_cast<double>(srgb_encode(linear > 1 ? 1.0f : linear));
}

}  // namespace

FilmMean film_mean(const Film& film) {
  const auto grey = [](Vec3f v) {
    return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3;
  };
  double sum = 0, variance = 0;
  const auto deviation = [&](const FilmPixel& pixel) {
    if (counted(film, pixel, 0) == 0 || counted(film, pixel, 1) == 0) return infinity;
    return (grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1))) / 2;
  };
  for (const FilmPixel& pixel : film.pixels) sum += grey(mean(film, pixel));
  for (const double group : group_sums(film, film.region, deviation)) variance += square(group);
  const auto pixels = static_cast<double>(film.pixels.size());
  return {sum / pixels, std::sqrt(variance) / pixels};
}

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

OutsideError outside_error(const std::vector<float>& image, const std::vector<float>& reference) {
  assert(image.size() == reference.size());
  const auto outside = [](float v) { return v < 0 || v > 1; };
  OutsideError error;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const bool finite = std::isfinite(image[i]) && std::isfinite(reference[i]);
    if (!finite || (!outside(image[i]) && !outside(reference[i]))) continue;
    error.rel_mse += squared_error(image[i], reference[i]);
    ++error.values;
  }
  if (error.values > 0) error.rel_mse /= static_cast<double>(error.values);
  return error;
}

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

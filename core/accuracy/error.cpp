#include "core/accuracy/error.h"

#include "core/base/text.h"
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

/// The pixel's position as "X,Y", and its first value that is not finite.
std::string place_text(const LinearImage& image, std::size_t pixel) {
  constexpr const char* channels[] = {"red", "green", "blue"};
  const float* rgb = image.rgb.data() + 3 * pixel;
  const float* wrong = std::find_if_not(rgb, rgb + 3, [](float v) { return std::isfinite(v); });
  const int width = image.width, x = static_cast<int>(pixel % static_cast<std::size_t>(width)),
            y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  const Region at = image.frame ? image.frame->data : Region{};
  return std::to_string(at.x0 + x) + "," + std::to_string(at.y0 + y) + " (" + channels[wrong - rgb] + " is " +
         number_text(static_cast<double>(*wrong)) + ")";
}

double grey(Vec3f v) { return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3; }

/// The sum of the grey values of a region's pixels, and its variance.
struct RegionSum {
  double value = 0, variance = 0;
  bool whole = true;  ///< both halves of every pixel have samples

  RegionSum(const Film& film, const Region& region) {
    const auto deviation = [&](const FilmPixel& pixel) {
      whole = whole && counted(film, pixel, 0) > 0 && counted(film, pixel, 1) > 0;
      value += grey(mean(film, pixel));
      return (grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1))) / 2;
    };
    for (const double group : group_sums(film, region, deviation)) variance += square(group);
  }
};

}  // namespace

FilmMean film_mean(const Film& film) {
  const RegionSum sum(film, film.region);
  const auto pixels = static_cast<double>(film.pixels.size());
  return {sum.value / pixels, sum.whole ? std::sqrt(sum.variance) / pixels : infinity};
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
  for (const Sum& sum : sums)
    errors.push_back(static_cast<float>(sum.count == 0 ? infinity : std::sqrt(sum.value / sum.count)));
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
  error.mse /= count;
  error.rmse = std::sqrt(error.mse);
  error.rel_mse /= count;
  error.psnr = -10 * std::log10(displayed_mse / count);
  error.mean_image = (3 / count) * Vec3d{sum_image[0], sum_image[1], sum_image[2]};
  error.mean_reference = (3 / count) * Vec3d{sum_reference[0], sum_reference[1], sum_reference[2]};
  return error;
}

bool is_finite(const LinearImage& image, std::size_t pixel) {
  const float* rgb = image.rgb.data() + 3 * pixel;
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

std::string not_finite_text(const LinearImage& image) {
  const std::size_t pixels = image.rgb.size() / 3;
  std::size_t wrong = 0, first = 0;
  for (std::size_t i = 0; i < pixels; ++i)
    if (!is_finite(image, i) && wrong++ == 0) first = i;
  if (wrong == 0) return "";
  return std::to_string(wrong) + " of " + std::to_string(pixels) + " pixels " + (wrong == 1 ? "is" : "are") +
         " not finite, the first at " + place_text(image, first);
}

BlockScores block_scores(const Film& a, const Film& b, int edge) {
  BlockScores scores;
  if (!(a.region == b.region)) return scores;
  const Region& r = a.region;
  double squares = 0;
  for (int y0 = r.y0; y0 < r.y1; y0 += edge)
    for (int x0 = r.x0; x0 < r.x1; x0 += edge) {
      const Region block{x0, y0, std::min(x0 + edge, r.x1), std::min(y0 + edge, r.y1)};
      const RegionSum of_a(a, block), of_b(b, block);
      if (!of_a.whole || !of_b.whole) return {};
      const double difference = of_a.value - of_b.value, variance = of_a.variance + of_b.variance;
      if (variance == 0 && difference == 0) continue;
      const double z2 = variance > 0 ? difference * difference / variance : infinity;
      scores.worst = std::max(scores.worst, std::sqrt(z2));
      squares += z2;
      ++scores.blocks;
    }
  if (scores.blocks == 0) return scores;
  scores.mean_square = squares / scores.blocks;
  // The standard errors are estimated, too, from one number for each group of both films: z follows Student's t
  // distribution, whose variance is freedom / (freedom - 2).
  const double freedom = 2.0 * edge * edge / group_size;
  scores.maximum = freedom / (freedom - 2) + 4 * std::sqrt(2.0 / scores.blocks);
  return scores;
}

}  // namespace tyndall

#include "app/report/film_difference.h"

#include "core/film/groups.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

double sum_of(Vec3f v) { return static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z); }

}  // namespace

FilmDifference film_difference(const Film& film, const Film& reference) {
  double sum = 0, squares = 0, noise = 0, group_noise = 0;
  bool whole = true;
  const auto deviation = [&](const FilmPixel& pixel) {
    const FilmPixel& other = reference.pixels[static_cast<std::size_t>(&pixel - film.pixels.data())];
    for (const int half : {0, 1})
      whole = whole && counted(film, pixel, half) > 0 && counted(reference, other, half) > 0;
    const Vec3f a = half_mean(film, pixel, 0) - half_mean(reference, other, 0);
    const Vec3f b = half_mean(film, pixel, 1) - half_mean(reference, other, 1);
    const Vec3f deviates = 0.5f * (a - b);
    sum += sum_of(mean(film, pixel) - mean(reference, other));
    squares += sum_of(a * b);
    noise += sum_of(deviates * deviates);
    return sum_of(deviates);
  };
  for (const double group : group_sums(film, film.region, deviation)) group_noise += group * group;
  const double values = 3.0 * static_cast<double>(film.pixels.size());
  FilmDifference difference;
  difference.mean = sum / values;
  difference.rms = std::sqrt(std::max(0.0, squares / values));
  if (!whole) return difference;
  difference.mean_error = std::sqrt(group_noise) / values;
  difference.rms_error = std::sqrt(noise / values);
  return difference;
}

}  // namespace tyndall

#pragma once
#include "core/accuracy/error.h"
#include "core/film/film.h"
#include "core/scene/scene.h"

#include <cassert>
#include <cstdint>
#include <vector>

/// Long renders that slow tests compare with, kept between runs.
namespace tyndall::test {

/// The means of the two halves of a long render, 3 floats a pixel: their errors are independent of each other.
struct Reference {
  std::vector<float> half[2];
};

/// Renders the scene with another seed, or reads what an earlier run left in references_folder(): two files whose names
/// hold a fingerprint of the scene, its settings and the number of samples.
Reference reference_of(Scene scene, std::uint32_t spp);

/// relMSE of a picture against the truth, without the noise of the reference: the mean of (x - a)(x - b) / (ref² + 0.01),
/// where a and b are the halves of the reference. May be negative where the picture is better than the reference.
inline double true_relative_mse(const std::vector<float>& image, const Reference& reference) {
  assert(image.size() == reference.half[0].size());
  double sum = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double x = static_cast<double>(image[i]), a = static_cast<double>(reference.half[0][i]),
                 b = static_cast<double>(reference.half[1][i]), level = (a + b) / 2;
    sum += (x - a) * (x - b) / (level * level + floor_of_square);
  }
  return sum / static_cast<double>(image.size());
}
inline double true_relative_mse(const Film& film, const Reference& reference) {
  return true_relative_mse(resolve(film), reference);
}

}  // namespace tyndall::test

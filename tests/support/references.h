#pragma once
#include "core/accuracy/error.h"
#include "core/base/fnv1a.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/paths.h"
#include "tests/support/prepared.h"

#include <cassert>
#include <cstdint>
#include <string>
#include <vector>

/// Long renders that slow tests compare with, kept between runs.
namespace tyndall::test {

/// The means of the two halves of a long render, 3 floats a pixel: their errors are independent of each other.
struct Reference {
  std::vector<float> half[2];
};

/// Renders the scene with another seed, or reads what an earlier run left in references_folder(): two files whose names
/// hold a fingerprint of the scene, its settings and the number of samples.
inline Reference reference_of(Scene scene, std::uint32_t spp) {
  scene.render.seed = 2718281828;
  scene.render.spp = static_cast<int>(spp);
  scene.render.adaptive = false;
  const std::filesystem::path folder = references_folder();
  std::filesystem::create_directories(folder);
  const std::string name = "halves-" + std::to_string(fnv1a(write_scene(scene)));
  const std::filesystem::path files[2] = {folder / (name + "-a.pfm"), folder / (name + "-b.pfm")};
  Reference reference;
  if (std::filesystem::exists(files[0]) && std::filesystem::exists(files[1])) {
    for (int half = 0; half < 2; ++half) reference.half[half] = read_image(files[half]).rgb;
    return reference;
  }
  const Film film = render(compile(scene), {.spp = spp}).film;
  for (int half = 0; half < 2; ++half) {
    for (const FilmPixel& pixel : film.pixels) {
      const Vec3f value = half_mean(film, pixel, half);
      reference.half[half].insert(reference.half[half].end(), {value.x, value.y, value.z});
    }
    write_pfm(files[half], {scene.width, scene.height, reference.half[half]});
  }
  return reference;
}

/// relMSE of a picture against the truth, without the noise of the reference: the mean of (x - a)(x - b) / (ref² +
/// 0.01), where a and b are the halves of the reference. May be negative where the picture is better than the
/// reference.
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

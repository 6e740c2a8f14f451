#pragma once
#include "core/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

/// A program as readers of "Ray Tracing in One Weekend" write it, with the mistakes that they make. It shares nothing
/// with the kernels but the scene: plain recursion in double, every object tested for every ray.
namespace tyndall::test {

/// Mistakes that are planted in the program.
enum class Plant {
  none,
  no_gamma,
  upside_down,
  mirrored,
  red_blue,
  short_paths,      ///< 3 rays
  schlick_is_one,   ///< r0 + (1 - r0) + pow(…)
  hemisphere,       ///< a uniform direction on the normal's side
  long_mirror,      ///< reflect(r_in.direction(), n) + fuzz * …
  positive_radius,  ///< of inner balls
  sky_brackets,     ///< 0.5 * y + 1.0
  lost_time,        ///< ray(p, direction) without the time
  no_defocus,
  acne,            ///< t from 0 on
  inverted_index,  ///< the index and its inverse have changed places
  by_value,        ///< attenuation by value: matt surfaces are black
  wrong_cross,     ///< a plus in the third component of the cross product
  own_sky,         ///< a pink sky, which nobody could guess
  twice,           ///< attenuation * attenuation * ray_color(…)
  cut_samples,     ///< each sample is cut off at 1, before the mean
  bright_lights    ///< lights and sky are a tenth brighter
};

/// What a program draws its numbers from.
enum class Generator { splitmix, mersenne_twister, minimal_standard, std_rand };

struct BookProgramPlan {
  int spp = 50;
  int edition = 4;  ///< 1 to 3 take fuzz in the ball; 2 and 3 have a frame that is 1 / (height - 1) taller
  bool srgb = false;
  Plant plant = Plant::none;
  std::uint64_t seed = 1;
  Generator generator = Generator::splitmix;
};

/// The bytes of the program's picture, 3 a pixel, top row first. The scene may have spheres, quads, boxes, media,
/// checkers; of transforms, turns and shifts.
std::vector<std::uint8_t> book_picture(const Scene& scene, const BookProgramPlan& plan);

/// The picture as a P3 file's text.
std::string ppm_text(int width, int height, const std::vector<std::uint8_t>& bytes);

}  // namespace tyndall::test

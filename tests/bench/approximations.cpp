#include "core/image/tonemap.h"
#include "core/render/progression.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/system/processors.h"
#include "tests/bench/bench.h"
#include "tests/support/double_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall::bench {
namespace {

/// A relative root mean square difference (as sqrt of relMSE) between two ways to render, and its standard error.
struct Shift {
  double rms = 0, error = 0;
};

constexpr int picture_pixels = 96 * 72;  // roughly: each scene keeps its ratio of width to height
constexpr std::uint32_t picture_spp = 256, clean_spp = 16;

Film film_of(const Scene& scene, const Kernels& kernels = *choose_kernels("")) {
  const auto prepared = prepare(scene);
  ThreadPool thread_pool(thread_count(0).count);
  Progression picture;
  picture.start(prepared->columns(), {0, 0, scene.width, scene.height}, 0, {});
  while (!picture.reached({.spp = picture_spp}))
    picture.run_pass({thread_pool, kernels, prepared->view()}, {.spp = picture_spp}, false);
  return picture.film();
}

/// From one squared relative difference a pixel: the root of their mean, and the standard error of that root.
Shift root_of_mean(const std::vector<double>& squares) {
  const auto n = static_cast<double>(squares.size());
  double sum = 0, spread = 0;
  for (const double s : squares) sum += s;
  const double mean = sum / n;
  for (const double s : squares) spread += (s - mean) * (s - mean);
  const double error = std::sqrt(spread / (n * (n - 1))), rms = std::sqrt(std::max(mean, 0.0));
  return {rms, rms > 0 ? std::min(error / (2 * rms), std::sqrt(error)) : std::sqrt(error)};
}

/// Mean over the channels of product(channel) / (mean² + 0.01), the scale of relMSE.
template <class Product>
double relative(Vec3f mean, Product product) {
  double sum = 0;
  for (float Vec3f::*channel : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
    const auto m = static_cast<double>(mean.*channel);
    sum += product(channel) / (m * m + 0.01) / 3;
  }
  return sum;
}

/// The shift between two films. Even and odd samples have independent noise, so the mean product of their two
/// differences is the mean square of the shift alone.
Shift shift(const Film& exact, const Film& other) {
  std::vector<double> squares;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const FilmPixel &a = exact.pixels[i], &b = other.pixels[i];
    const Vec3f even = half_mean(other, b, 0) - half_mean(exact, a, 0);
    const Vec3f odd = half_mean(other, b, 1) - half_mean(exact, a, 1);
    squares.push_back(relative(mean(exact, a), [&](float Vec3f::*channel) {
      return static_cast<double>(even.*channel) * static_cast<double>(odd.*channel);
    }));
  }
  return root_of_mean(squares);
}

Shift shift_of_bytes(const Film& film) {
  std::vector<double> squares;
  for (const FilmPixel& pixel : film.pixels) {
    const Vec3f value = mean(film, pixel);
    squares.push_back(relative(value, [&](float Vec3f::*channel) {
      const float clipped = std::clamp(value.*channel, 0.0f, 1.0f);
      const float back = srgb_decode(static_cast<float>(std::lround(255 * srgb_encode(clipped))) / 255);
      return static_cast<double>(back - clipped) * static_cast<double>(back - clipped);
    }));
  }
  return root_of_mean(squares);
}

/// The clean view of the scene with another seed.
CleanPicture clean_of(Scene scene, std::uint32_t seeds_on) {
  scene.render.seed += seeds_on;
  return *render(*prepare(scene), {.spp = clean_spp, .clean = true}).clean;
}

/// What is wrong in the mean of clean views: of two, and of the halves of the exact film, all noise is independent.
Shift shift_of_clean(const Scene& scene, const Film& exact) {
  const CleanPicture one = clean_of(scene, 1), other = clean_of(scene, 2);
  std::vector<double> squares;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const FilmPixel& pixel = exact.pixels[i];
    const auto colour = [i](const CleanPicture& of) {
      return Vec3f{of.rgb[3 * i], of.rgb[3 * i + 1], of.rgb[3 * i + 2]};
    };
    const Vec3f a = colour(one) - half_mean(exact, pixel, 0), b = colour(other) - half_mean(exact, pixel, 1);
    squares.push_back(relative(mean(exact, pixel), [&](float Vec3f::*channel) {
      return static_cast<double>(a.*channel) * static_cast<double>(b.*channel);
    }));
  }
  return root_of_mean(squares);
}

Shift shift_of_depth(Scene scene, const Film& exact, int depth) {
  scene.render.max_depth = depth;
  return shift(exact, film_of(scene));
}

/// The shifts of one scene from its exact picture: exact Fresnel terms, paths of up to 1000 events, linear floats.
/// Renders the scene small, each way with the same random numbers: where both ways take the same path, noise cancels.
/// The noise that is left differs between the two halves, so it averages to 0 in the product of their differences.
std::vector<Shift> shifts_of(Scene scene) {
  const double scale =
      std::sqrt(static_cast<double>(picture_pixels) / (static_cast<double>(scene.width) * scene.height));
  scene.width = std::max(static_cast<int>(std::lround(scene.width * scale)), 1);
  scene.height = std::max(static_cast<int>(std::lround(scene.height * scale)), 1);
  scene.render.fresnel = FresnelKind::exact;
  scene.render.max_depth = 1000;
  const Film exact = film_of(scene);
  Scene books = scene;
  books.render.fresnel = FresnelKind::schlick;
  return {shift(exact, film_of(books)),
          shift_of_depth(scene, exact, 5),
          shift_of_depth(scene, exact, 10),
          shift_of_depth(scene, exact, 50),
          shift(film_of(scene, test::double_kernels()), exact),
          shift_of_bytes(exact),
          shift_of_clean(scene, exact)};
}

/// "0.18 ± 0.02", "< 0.01" where nothing is seen above the noise, or "0".
std::string shown(const Shift& s) {
  if (s.rms == 0 && s.error == 0) return "0";
  char text[64];
  if (s.rms > s.error)
    std::snprintf(text, sizeof text, "%.2g ± %.1g", 100 * s.rms, 100 * s.error);
  else
    std::snprintf(text, sizeof text, "< %.1g", 100 * (s.rms + 2 * s.error));
  return text;
}

}  // namespace

void measure_approximations(const Settings& settings) {
  const Table table(
      "Relative RMS difference in %, ± standard error, from exact Fresnel terms, 1000 events, linear floats",
      {"scene", "schlick", "depth 5", "depth 10", "depth 50", "float lanes", "8 bit", "clean, 16 spp"});
  for (const BuiltIn& built_in : built_in_scenes()) {
    if (settings.quick && built_in.name != "showroom" && built_in.name != "cornell-box") continue;
    std::vector<std::string> cells{built_in.name};
    for (const Shift& one : shifts_of(load_scene(built_in.name).scene)) cells.push_back(shown(one));
    table.add(cells);
  }
}

}  // namespace tyndall::bench

#include "core/trace/flight.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Tiny lights in media, where distances are sampled by angle. Samples that scatter next to them have no upper bound;
/// renderers that clamp samples lose that light.
namespace tyndall::test::light_in_media_test {

namespace {

constexpr double light_radius = 0.01, medium_radius = 2, medium_density = 0.5, albedo = 0.9, brightness = 100;

/// Light that a point in the media at distance d from the light's centre receives from all sides: transmittance to the
/// light's surface over its solid angle.
double fluence(double d) {
  const double sine2 = light_radius * light_radius / (d * d), part = sine2 / (1 + std::sqrt(1 - sine2));
  return brightness * integrate(
                          [&](double x) {  // 1 - cos of the angle from the light's middle, as a part of its cap
                            const double cosine = 1 - x * part, across2 = d * d * (1 - cosine) * (1 + cosine);
                            const double near =
                                d * cosine - std::sqrt(std::max(light_radius * light_radius - across2, 0.0));
                            return 2 * pi * part * std::exp(-medium_density * near);
                          },
                          0, 1, 8);
}

/// Light scattered once into a ray of impact parameter b.
double scattered_once(double b) {
  const double half = std::sqrt(medium_radius * medium_radius - b * b);
  const auto at = [&](double x) {
    const double d = std::sqrt(b * b + x * x);
    return medium_density * albedo * std::exp(-medium_density * (x + half)) * fluence(d) / (4 * pi);
  };
  double sum = 0;  // finer towards the light
  for (double far = half; far > 1e-4; far /= 2) {
    const double near = far / 2 > 1e-4 ? far / 2 : 0;
    sum += integrate(at, -far, -near, 20) + integrate(at, near, far, 20);
  }
  return sum;
}

/// The mean that would be left if each sample were clamped to `maximum`.
double clamped_mean(Scene scene, double maximum) {
  scene.width = scene.height = 256;
  const Film film = film_of(scene, 1);
  double sum = 0;
  for (const FilmPixel& pixel : film.pixels) sum += std::min(static_cast<double>(mean(film, pixel).x), maximum);
  return sum / static_cast<double>(film.pixels.size());
}

/// Squared difference of two colours over that of a reference, as in relMSE.
double relative_square(Vec3f difference, Vec3f reference) {
  double sum = 0;
  for (float Vec3f::*channel : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
    const auto d = static_cast<double>(difference.*channel), r = static_cast<double>(reference.*channel);
    sum += d * d / (r * r + 0.01);
  }
  return sum;
}

}  // namespace

TEST_CASE("light in media: light scattered once, next to a light of radius 0.01 and far from it, is all there") {
  ZScores scores;
  std::uint32_t seed = 0;
  for (const double impact : {0.012, 0.05, 0.4, 1.5})
    for (const Integrator integrator : {Integrator::nee, Integrator::mis}) {
      Scene scene = dark_room();
      scene.render.integrator = integrator;
      scene.render.max_depth = 1;
      scene.render.seed = ++seed;
      add(scene, sphere({0, 0, 0}, light_radius), lamp(brightness));
      add_medium(scene, sphere({0, 0, 0}, medium_radius), {medium_density, 0}, albedo);
      aim(scene, {impact, 0, 5}, {impact, 0, 0});
      CAPTURE(impact);
      const Film film = film_of(scene, 2048);
      CHECK(totals(film).rejected == 0);
      // With mis, distances by angle leave next to no noise. With nee, the rare bright samples that a clamp would cut
      // carry a good part of the light.
      const bool by_angle = integrator == Integrator::mis;
      scores.add("radiance", estimate(channel_of(film)), scattered_once(impact), by_angle ? 1e-3 : 0.01);
      if (impact < 0.1 && !by_angle) CHECK(clamped_mean(scene, 0.1) < 0.7 * scattered_once(impact));
    }
}

TEST_CASE("light in media: the estimated error, from the two halves, is close to the true one") {
  Scene scene =
      thorough() ? small_scene("stress-light-in-fog", 64, 48, 1) : small_scene("stress-light-in-fog", 32, 24, 1);
  const auto render_with = [&](std::uint32_t seed, int spp) {
    scene.render.seed = seed;
    return film_of(scene, spp);
  };
  const Film reference = render_with(1000, 4096);
  double reported = 0, there = 0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    const Film film = render_with(seed, 64);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      const Vec3f exact = mean(reference, reference.pixels[i]), value = mean(film, film.pixels[i]);
      const Vec3f halves = half_mean(film, film.pixels[i], 0) - half_mean(film, film.pixels[i], 1);
      reported += relative_square(0.5f * halves, exact);
      there += relative_square(value - exact, exact);
    }
  }
  const double ratio = std::sqrt(reported / there);
  CHECK(ratio > 0.9);
  CHECK(ratio < 1.1);
}

TEST_CASE("lights in media: distances by angle have the stated pdf") {
  const Vec3f across{0, 0.3f, 0}, direction{1, 0, 0};
  for (const float reach : {0.0f, 0.01f, 1.0f})
    for (const float end : {-0.5f, 0.001f, 40.0f}) {
      const Equiangular<float> distances = equiangular(across, reach * reach, direction, -1.0f, end);
      const auto claimed = [&](double t) { return static_cast<double>(pdf(distances, static_cast<float>(t))); };
      CHECK(integrate(claimed, -1, static_cast<double>(end)) == doctest::Approx(1).epsilon(2e-5).scale(0));
      std::vector<double> drawn;
      for (int i = 0; i < 2000; ++i)
        drawn.push_back(static_cast<double>(sample(distances, (static_cast<float>(i) + 0.5f) / 2000)));
      const auto below = [&](double t) { return integrate(claimed, -1, t, 500); };
      CHECK(kolmogorov_smirnov(drawn, below) < 0.05);  // evenly placed, so far below chance
    }
}

TEST_CASE("lights in media: what light sampling alone finds, with far less noise") {
  Scene scene = dark_room();
  scene.render.max_depth = 4;
  add(scene, sphere({0, 0, 0}, 0.01), lamp(1e4));
  add_medium(scene, sphere({0, 0, 0}, 2), {0.4, 0.5}, 0.8);
  add(scene, Quad<>{{-3, -1, -3}, {6, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  add(scene, Quad<>{{0.5, 0.3, 0}, {0.1, 0, 0}, {0, 0.05, 0.1}}, lamp(50));
  add_medium(scene, Box<>{{-1, -0.9, -1}, {1, 1, 1}}, {0.3, -0.3}, 0.9, {RotateY{30}});
  add_medium(scene, sphere({0, 0, 0}, 2), {0.1, 0}, 0.5);  // a second medium, as large as the first
  // Beside the lights, whose edges would otherwise make most of the noise.
  scene.camera = {.look_from = {0, 0.5, 5}, .look_at = {0.8, 0, 0}, .vfov = 4};
  CHECK(compile(scene).near.light.size() == 0);
  scene.render.integrator = Integrator::mis;
  const RenderScene compiled = compile(scene);
  CHECK(compiled.near.light == std::vector<std::int32_t>{0, 1, 0, 1, 0, 1});
  CHECK(compiled.kernel == KernelSet::no_specular_paths);
  const int spp = thorough() ? 128 : 32;
  const Estimate mis = over_seeds(scene, Integrator::mis, spp), nee = over_seeds(scene, Integrator::nee, 4 * spp);
  check_agree(mis, nee);
  CHECK(mis.error < 0.004 * std::sqrt(128.0 / spp) * mis.mean);
  CHECK(mis.error < 2 * nee.error);  // with equal numbers of samples
}

TEST_CASE("lights in media: sampled by angle only where it pays") {
  CHECK(compile(load_scene("stress-light-in-fog").scene).near.light.size() == 1);
  for (const char* name : {"cornell-smoke", "next-week", "showroom", "stress-dense-fog"})
    CHECK(compile(load_scene(name).scene).near.light.size() == 0);
}

}  // namespace tyndall::test::light_in_media_test

#include "core/trace/flight.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Several media at once, media that only absorb, whose paths carry what passes (flight.h), and tiny lights in media,
/// where distances are sampled by angle; known answers of one medium are cases of "tyndall verify".
namespace tyndall::test::media_test {

namespace {

/// A ray through the middle of spheres of media of radius 1, with the white sky behind them.
Scene through_medium(const std::vector<double>& densities, Integrator integrator) {
  Scene scene = white_room();
  scene.render.integrator = integrator;
  for (const double density : densities) add_medium(scene, sphere({0, 0, 0}, 1), {density, 0}, 0);
  aim(scene, {0, 0, 5}, {0, 0, 0});
  return scene;
}

/// How many single samples are not one of these values, within 1e-6 of it.
int count_others(const Scene& scene, const std::vector<double>& values, const std::string& isa = "") {
  const Film film = film_of(scene, 1, isa);
  return static_cast<int>(std::count_if(film.pixels.begin(), film.pixels.end(), [&](const FilmPixel& pixel) {
    const double x = static_cast<double>(mean(film, pixel).x);
    return std::none_of(values.begin(), values.end(), [x](double v) { return std::abs(x - v) <= 1e-6 * v; });
  }));
}

}  // namespace

TEST_CASE("smoke: where much passes, every path carries it, without noise; where little passes, some carry an eighth") {
  for (const char* isa : {"", "scalar"}) {
    CHECK(count_others(through_medium({0.3}, Integrator::mis), {std::exp(-0.6)}, isa) == 0);
    CHECK(count_others(through_medium({0.3, 0.9}, Integrator::mis), {std::exp(-2.4)}, isa) == 0);
  }
  for (const Integrator integrator : {Integrator::path, Integrator::nee})
    CHECK(count_others(through_medium({0.3}, integrator), {0, 1}) == 0);
  const Scene thick = through_medium({2.5}, Integrator::mis);
  CHECK(count_others(thick, {0, 0.125}) == 0);
  ZScores scores;
  scores.add("exp(-5)", radiance(thick, 512), std::exp(-5));
  scores.add("exp(-6)", radiance(through_medium({2.5, 0.5}, Integrator::mis), 512), std::exp(-6));
}

TEST_CASE("smoke: hides no light from a lamp in fog, and none that comes through a ball of glass") {
  for (const bool in_fog : {true, false}) {
    Scene scene = dark_room();
    scene.render.integrator = Integrator::mis;
    add(scene, Quad<>{{-6, 0, -6}, {0, 0, 12}, {12, 0, 0}}, lambertian(0.7));
    if (in_fog) {
      add(scene, sphere({0, 1.5, 1}, 0.02), lamp(3000));
      add_medium(scene, sphere({0, 1.5, 1}, 1.5), {0.5, 0}, 0.9);
      add_medium(scene, sphere({0.5, 1.5, 1}, 1.2), {0.6, 0}, 0);
      scene.camera = {.look_from = {0, 3, 8}, .look_at = {1, 1, 0}, .vfov = 10};
      CHECK(compile(scene).near.light.size() == 1);
    } else {
      add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
      add(scene, sphere({0.3, 1.3, 0}, 0.1), lamp(300));
      add_medium(scene, sphere({0, 1.2, 0}, 2.5), {0.5, 0}, 0);
      scene.camera = {.look_from = {0, 4, 6}, .look_at = {0, 0, 1}, .vfov = 20};
      CHECK(compile(scene).specular.sphere.size() == 1);
    }
    // By nee, media ends paths by chance; mis has half of its noise with as many samples.
    const Estimate mis = over_seeds(scene, Integrator::mis, 64), nee = over_seeds(scene, Integrator::nee, 256);
    check_agree(mis, nee);
    CHECK(mis.error < 0.5 * 2 * nee.error);
  }
}

TEST_CASE("fog: media that overlap, or lie in a row, add up, in density and in colour") {
  ZScores scores;
  Scene absorbing = through_medium({0.7}, Integrator::path);
  add_medium(absorbing, Box<>{{-0.5, -1, -2}, {0.5, 1, 0.25}}, {0.4, 0}, 0);
  scores.add("absorption", radiance(absorbing, 512), std::exp(-0.7 * 2 - 0.4 * 2.25));
  // Two equal spheres, one black, one white, are one sphere of twice the density and albedo 1/2.
  Scene mixed = sphere_seen_at(0, 1);
  mixed.render.seed = 5;
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 1);
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 0);
  scores.add("equal balls", radiance(mixed, 512), 0.41049922560061036, 5e-3);
  // A sphere that is half one, half another medium of the same kind.
  Scene split = sphere_seen_at(0.6, 1);
  split.render.seed = 6;
  add_medium(split, sphere({0, 0, 0}, 1), {1.5, 0}, 0.9);
  add_medium(split, sphere({0, 0, 0}, 1), {0.5, 0}, 0.9);
  scores.add("layers", radiance(split, 512), 0.7518521509111393, 5e-3);
  Scene row = white_room();
  for (int i = 0; i < 10; ++i) add_medium(row, sphere({0, 0, 3.0 * i}, 1), {0.05, 0}, 0);
  aim(row, {0, 0, 50}, {0, 0, 0});
  scores.add("row", radiance(row, 512), std::exp(-1.0), 0.02);
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

}  // namespace tyndall::test::media_test

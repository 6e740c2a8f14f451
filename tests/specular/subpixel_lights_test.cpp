#include "core/trace/subpixel_lights.h"

#include "core/targets/replay.h"
#include "core/trace/scene_view.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

/// Subpixel lights: samples that are drawn within boxes keep every mean, and the boxes hold what the camera sees of
/// lights.
namespace tyndall::test::subpixel_lights_test {

namespace {

/// A small light over a floor, with a sphere beside it, before a camera of 80 x 60 pixels.
Scene light_and_sphere(const Material& of_sphere, double light_radius) {
  Scene scene = dark_room();
  scene.width = 80, scene.height = 60;
  scene.render.integrator = Integrator::mis;
  scene.camera.look_from = {0, 3, 7}, scene.camera.look_at = {0, 1, 0}, scene.camera.vfov = 40;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.73));
  add(scene, sphere({1.5, 4.5, 0.5}, light_radius), lamp(1.8 / (light_radius * light_radius)));
  add(scene, sphere({0, 1.2, 0}, 1), of_sphere);
  return scene;
}

/// Variance of a pixel's mean between seeds, averaged over the picture; and the picture's mean, with its error.
struct Spread {
  double variance, mean, error;
};
Spread spread_of_seeds(Scene scene, std::uint32_t spp) {
  constexpr int seeds = 8;
  const auto pixels = static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  std::vector<double> sum(pixels, 0), squares(pixels, 0);
  double means = 0, mean_squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    scene.render.seed = static_cast<std::uint32_t>(seed + 1);
    const Film film = render(*prepare(scene), {.spp = spp}).film;
    double whole = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto value = static_cast<double>(mean(film, film.pixels[i]).x);
      sum[i] += value, squares[i] += value * value, whole += value / static_cast<double>(pixels);
    }
    means += whole, mean_squares += whole * whole;
  }
  double variance = 0;
  for (std::size_t i = 0; i < pixels; ++i)
    variance += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1) / static_cast<double>(pixels);
  const double between = (mean_squares - means * means / seeds) / (seeds - 1);
  return {variance, means / seeds, std::sqrt(between / seeds)};
}

}  // namespace

TEST_CASE("subpixel lights: weighted samples keep the mean of every part of a pixel, where boxes overlap as well") {
  const float throughput = subpixel_light_fraction / 3;
  const auto box = [&](float left, float top, float width, float height, int place) {
    const float begin = throughput * static_cast<float>(place);
    return SubpixelLight{7,    5, left, top, width, height, begin, begin + throughput, throughput / (width * height),
                         place};
  };
  const std::vector<SubpixelLight> list{box(0.1f, 0.2f, 0.5f, 0.1f, 0), box(0.4f, 0.1f, 0.3f, 0.6f, 1),
                                        box(0.5f, 0.25f, 0.001f, 0.002f, 2)};
  const SubpixelLights subpixel_lights{list.data(), list.data() + list.size()};
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> u(0, 1);
  constexpr int count = 400'000;
  double whole = 0, first = 0, both = 0, smallest = 0, hits = 0;
  for (int i = 0; i < count; ++i) {
    const float x = u(engine);
    Pair<float> at{x, u(engine)};
    const auto weight = static_cast<double>(aim_at_subpixel_lights(subpixel_lights, 7.0f, 5.0f, at).weight) / count;
    const auto inside = [&](const SubpixelLight& g) {
      return at.x >= g.left && at.x < g.left + g.width && at.y >= g.top && at.y < g.top + g.height;
    };
    whole += weight;
    if (inside(list[0])) first += weight;
    if (inside(list[0]) && inside(list[1])) both += weight;
    if (inside(list[2])) smallest += weight, ++hits;
    CHECK_FALSE((at.x < 0 || at.x >= 1 || at.y < 0 || at.y >= 1));
  }
  CHECK(whole == doctest::Approx(1).epsilon(0.01).scale(0));
  CHECK(first == doctest::Approx(0.05).epsilon(0.01).scale(0));
  CHECK(both == doctest::Approx(0.02).epsilon(0.01).scale(0));
  CHECK(smallest == doctest::Approx(2e-6).epsilon(0.01).scale(0));
  CHECK(hits / count == doctest::Approx(subpixel_light_fraction / 3).epsilon(0.02).scale(0));
  Pair<float> at{0.25f, 0.75f};
  CHECK(aim_at_subpixel_lights(subpixel_lights, 7.0f, 6.0f, at).weight == 1);  // the pixel below
  CHECK(at.x == 0.25f);
  at = {0.9f, 0.3f};  // is moved to (0.8, 0.3), beside the boxes
  CHECK(aim_at_subpixel_lights(subpixel_lights, 7.0f, 5.0f, at).route.packed == 0);
  at = {0.21f, 0.4f};  // is moved into the middle box, where the small one is not
  CHECK(aim_at_subpixel_lights(subpixel_lights, 7.0f, 5.0f, at).route.packed == 1);
}

TEST_CASE("subpixel lights: many samples, not a few bright ones, meet a light seen by reflections inside glass") {
  struct Case {
    bool hollow;
    double light_radius, maximum;
  };
  for (const auto& [hollow, light_radius, maximum] :
       {Case{false, 0.03, 50}, Case{true, 0.03, 400}, Case{false, 0.5, 50}}) {
    Scene scene = light_and_sphere(glass(1.5), light_radius);
    scene.materials[0] = lambertian(0);
    if (hollow) add(scene, sphere({0, 1.2, 0}, -0.8), glass(1.5));
    const RenderScene compiled = compile(scene);
    const SceneViewOf made(compiled);
    const SceneView& view = made.view();
    // Of the pixels that show the light by two reflections: the second moment of their samples, over their squared
    // mean.
    double squared_means = 0, second_moments = 0;
    int whole_pixels = 0;
    for (int i = 0; i < view.subpixel_lights.count(); ++i) {
      const SubpixelLight& g = view.subpixel_lights[i];
      if (g.route < pack_route(2, 0) || g.route >= pack_route(3, 0)) continue;
      whole_pixels += g.width * g.height > 0.99f ? 1 : 0;
      constexpr int samples = 4096;
      double sum = 0, squares = 0;
      for (std::uint32_t k = 0; k < samples; ++k) {
        const PathReplay path = replay(view, static_cast<int>(g.x), static_cast<int>(g.y), k);
        const auto value = static_cast<double>(path.radiance.x) / samples;
        sum += value, squares += samples * value * value;
      }
      squared_means += sum * sum, second_moments += squares;
    }
    REQUIRE(squared_means > 0);
    CHECK(second_moments / squared_means < maximum);
    if (light_radius > 0.1) CHECK(whole_pixels > 0);
  }
}

TEST_CASE("subpixel lights: found in a mirror sphere, in glass and beside it, unless the camera has a lens") {
  for (const Material& kind : {metal(0.9, 0), glass(1.5)}) {
    Scene scene = light_and_sphere(kind, 0.01);
    const RenderScene compiled = compile(scene);
    const SceneViewOf view(compiled);
    REQUIRE(view.view().subpixel_lights.count() > 0);
    scene.camera.defocus_angle = 0.5;
    const RenderScene with_lens = compile(scene);
    CHECK(SceneViewOf(with_lens).view().subpixel_lights.count() == 0);
    scene.camera.defocus_angle = 0;
    scene.render.caustics = Caustics::scatter;
    const RenderScene by_chance = compile(scene);
    CHECK(SceneViewOf(by_chance).view().subpixel_lights.count() == 0);
  }
}

TEST_CASE("subpixel lights: they lose no light and add little noise") {
  for (const Material& kind : {metal(0.9, 0), glass(1.5)}) {
    Scene dark = light_and_sphere(kind, 0.05);
    // No surface scatters light evenly but one that carries none, so that all light is what the camera sees of the
    // light.
    dark.materials[0] = lambertian(0);
    const Spread with = spread_of_seeds(dark, 64);
    dark.render.caustics = Caustics::scatter;
    const Spread without = spread_of_seeds(dark, 512);
    CAPTURE(with.mean);
    CAPTURE(without.mean);
    CHECK(std::abs(with.mean - without.mean) < 4 * std::hypot(with.error, without.error));
    CHECK(with.variance < without.variance);  // with eight times fewer samples
  }
}

TEST_CASE("subpixel lights: images in metal of little fuzz lose no light and are less noisy") {
  Scene dark = small_scene("stress-small-fuzz", 80, 60, 1);
  dark.materials[0].colour = Vec3d{0, 0, 0};
  REQUIRE(prepare(dark)->guide().lobes() > 0);
  CHECK(prepare(dark)->view().subpixel_lights.count() > 3);
  const Spread with = spread_of_seeds(dark, 64);
  dark.render.caustics = Caustics::scatter;
  CHECK(prepare(dark)->view().subpixel_lights.count() == 0);
  const Spread without = spread_of_seeds(dark, 64);
  CAPTURE(with.mean);
  CAPTURE(without.mean);
  CHECK(std::abs(with.mean - without.mean) < 4 * std::hypot(with.error, without.error));
  CHECK(with.variance < 0.5 * without.variance);
}

}  // namespace tyndall::test::subpixel_lights_test

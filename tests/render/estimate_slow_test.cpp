#include "core/accuracy/estimate.h"
#include "tests/support/pictures.h"
#include "tests/support/random_draws.h"
#include "tests/support/references.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

/// How close the estimated error is to the true one, and whether pictures are flagged where it is not.
namespace tyndall::test::estimate_slow_test {

namespace {

constexpr double pixels = 9216;  // pixels of a built-in scene's picture, such as 128 x 72; random rooms have more
constexpr std::array<std::uint32_t, 6> counts{4, 8, 16, 30, 64, 256};

struct Case {
  std::string name;
  std::uint32_t spp;
  double ratio;  // estimated over true relative error; 1 if the picture has no noise, and is estimated to have none
  bool flagged;
  bool outside() const { return ratio < 0.8 || ratio > 1.25; }
};

/// A picture of about so many pixels.
Scene resized(Scene scene) {
  const double aspect = static_cast<double>(scene.width) / scene.height;
  scene.height = static_cast<int>(std::lround(std::sqrt(pixels / aspect)));
  scene.width = static_cast<int>(std::lround(scene.height * aspect));
  scene.render.adaptive = false;
  return scene;
}

void add_cases(const std::string& name, const Scene& scene, std::uint32_t reference_spp, std::vector<Case>& cases) {
  const Reference reference = reference_of(scene, reference_spp);
  const RenderScene compiled = compile(scene);
  const double chance = prepare(scene)->caustic_chance();
  const Kernels kernels = choose_kernels("").value();
  Film film;
  for (const std::uint32_t spp : counts) {
    film = render(compiled, {.spp = spp}, {}, std::move(film)).film;
    const double truth = std::sqrt(std::max(true_relative_mse(film, reference), 1e-30));
    const ErrorEstimate estimate = estimate_error(compiled, kernels, film);
    const double estimated = estimate.relative_error;
    constexpr double no_noise = 1e-7;
    const double ratio = estimated < no_noise && truth < no_noise ? 1 : estimated / truth;
    cases.push_back({name, spp, ratio, has_rare_bright_paths(estimate, spp, chance)});
    const Case& one = cases.back();
    if (one.outside() || one.flagged)
      std::printf("%-26s %3u spp  true %.3g  estimated %.3g  ratio %.2f%s%s\n", name.c_str(), spp, truth, estimated,
                  one.ratio, one.outside() ? "  outside" : "", one.flagged ? "  flagged" : "");
  }
}

/// Prints a row for each number of samples.
void print_table(const std::vector<Case>& cases) {
  for (const std::uint32_t spp : counts) {
    std::vector<double> ratios;
    int outside = 0, flagged = 0;
    for (const Case& one : cases) {
      if (one.spp != spp) continue;
      ratios.push_back(one.ratio);
      outside += one.outside() ? 1 : 0, flagged += one.flagged ? 1 : 0;
    }
    std::sort(ratios.begin(), ratios.end());
    std::printf("%3u spp: median %.2f [%.2f ... %.2f], %d of %zu outside, %d flagged\n", spp, ratios[ratios.size() / 2],
                ratios.front(), ratios.back(), outside, ratios.size(), flagged);
  }
}

/// Among the cases with at least min_spp samples, the share whose estimate is too far from the true error.
double fraction_outside(const std::vector<Case>& cases, std::uint32_t min_spp) {
  double outside = 0, all = 0;
  for (const Case& one : cases)
    if (one.spp >= min_spp) ++all, outside += one.outside() ? 1 : 0;
  return outside / all;
}

double median(const std::vector<Case>& cases, std::uint32_t spp) {
  std::vector<double> ratios;
  for (const Case& one : cases)
    if (one.spp == spp) ratios.push_back(one.ratio);
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

/// A floor with 3 to 9 spheres and boxes of all materials, one to three lights, sometimes walls, a sky or media. A pure
/// function of the seed.
class RandomRoom : RandomDraws {
 public:
  explicit RandomRoom(unsigned seed) : RandomDraws(seed) {}

  Scene scene() {
    scene_.width = 192, scene_.height = 108;
    scene_.camera.look_from = {between(-3, 3), between(1, 4), between(5, 8)};
    scene_.camera.look_at = {between(-0.5, 0.5), between(0.5, 1.2), 0};
    scene_.camera.vfov = between(30, 55);
    const bool walls = chance(0.4);
    if (!walls && chance(0.6)) scene_.background = Gradient{grey(0.05, 1), {between(0, 0.6), 0.5, between(0.2, 1)}};
    add(Quad<>{{-20, 0, -20}, {40, 0, 0}, {0, 0, 40}}, matt());
    if (walls) add(Quad<>{{-8, 0, -4}, {16, 0, 0}, {0, 8, 0}}, matt());
    if (walls) add(Quad<>{{-5, 0, -4}, {0, 0, 9}, {0, 8, 0}}, matt());
    for (int i = 3 + below(7); i > 0; --i) add_thing();
    for (int i = 1 + below(3); i > 0; --i) add_light();
    if (chance(0.3)) add_medium();
    return scene_;
  }

 private:
  Scene scene_;

  Vec3d grey(double low, double high) {
    const double level = between(low, high);
    return {level, level, level};
  }
  Material matt() { return {"", colour(), Lambertian<>{}}; }
  Material any_material() {
    const double kind = between(0, 1);
    if (kind < 0.55) return matt();
    if (kind < 0.8) return {"", colour(), Metal<>{chance(0.3) ? 0 : between(0.02, 1)}};
    return {"", Vec3d{1, 1, 1}, Dielectric<>{between(1.2, 2)}};
  }
  template <class Shape>
  void add(const Shape& shape, Material material) {
    const auto index = static_cast<int>(scene_.materials.size());
    material.name = "m" + std::to_string(index);
    scene_.materials.push_back(std::move(material));
    scene_.objects.push_back({"", Solid3d{shape, index}, {}});
  }
  void add_thing() {
    const double size = between(0.2, 0.9), x = between(-3, 3), z = between(-3, 2);
    if (chance(0.6)) return add(Sphere<>{{x, size, z}, size, {}}, any_material());
    add(Box<>{{x - size, 0, z - size}, {x + size, between(0.3, 2), z + size}}, any_material());
  }
  /// Adds a light; all have about the same power, however small they are.
  void add_light() {
    const double size = std::exp(between(std::log(0.2), std::log(1.0))), radiance = between(1, 6) / (size * size);
    const Vec3d at{between(-3, 3), between(2.5, 5), between(-3, 3)};
    const Material lamp{"", Vec3d{radiance, between(0.6, 1) * radiance, between(0.4, 1) * radiance}, Light<>{}};
    if (chance(0.5)) return add(Sphere<>{at, size, {}}, lamp);
    add(Quad<>{at, {2 * size, 0, 0}, {0, 0, 2 * size}}, lamp);
  }
  void add_medium() {
    Volume fog;
    fog.boundary = Box<>{{-6, 0, -6}, {6, 6, 6}};
    fog.medium = {between(0.01, 0.15), between(-0.5, 0.8)};
    fog.albedo = grey(0.6, 1);
    scene_.objects.push_back({"", fog, {}});
  }
};

}  // namespace

TEST_CASE("estimated error: within a quarter of the true one in 98 of 100 built-in scenes, and flagged elsewhere") {
  std::vector<Case> cases;
  for (const BuiltIn& built_in : built_in_scenes())
    add_cases(built_in.name, resized(load_scene(built_in.name).scene), 2048, cases);
  print_table(cases);
  CHECK(cases.size() >= 44 * counts.size());
  CHECK(fraction_outside(cases, 0) <= 0.02);
  for (const std::uint32_t spp : counts) CHECK(median(cases, spp) == doctest::Approx(1).epsilon(0.05).scale(0));
  for (const Case& one : cases) {
    CAPTURE(one.name);
    CAPTURE(one.spp);
    CAPTURE(one.ratio);
    if (one.outside()) CHECK(one.flagged);
  }
}

TEST_CASE("estimated error: within a quarter of the true one in 9 of 10 random rooms, from 8 samples on") {
  std::vector<Case> cases;
  for (unsigned seed = 1; seed <= 30; ++seed)
    add_cases("room " + std::to_string(seed), RandomRoom(seed).scene(), 1024, cases);
  print_table(cases);
  CHECK(fraction_outside(cases, 8) <= 0.1);
}

}  // namespace tyndall::test::estimate_slow_test

#include "core/accuracy/estimate.h"
#include "tests/support/pictures.h"
#include "tests/support/references.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

/// How close the estimated error is to the true one, and whether pictures are flagged where it is not.
namespace tyndall::test::estimate_slow_test {

namespace {

constexpr double pixels = 9216;  // such as 128 x 72
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

/// The share of cases whose estimate is too far from the true error.
double fraction_outside(const std::vector<Case>& cases) {
  const auto outside = std::count_if(cases.begin(), cases.end(), [](const Case& one) { return one.outside(); });
  return static_cast<double>(outside) / static_cast<double>(cases.size());
}

double median(const std::vector<Case>& cases, std::uint32_t spp) {
  std::vector<double> ratios;
  for (const Case& one : cases)
    if (one.spp == spp) ratios.push_back(one.ratio);
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace

TEST_CASE("estimated error: within a quarter of the true one in 98 of 100 built-in scenes, and flagged elsewhere") {
  std::vector<Case> cases;
  for (const BuiltIn& built_in : built_in_scenes())
    add_cases(built_in.name, resized(load_scene(built_in.name).scene), 2048, cases);
  print_table(cases);
  CHECK(cases.size() >= 44 * counts.size());
  CHECK(fraction_outside(cases) <= 0.02);
  for (const std::uint32_t spp : counts) CHECK(median(cases, spp) == doctest::Approx(1).epsilon(0.05).scale(0));
  for (const Case& one : cases) {
    CAPTURE(one.name);
    CAPTURE(one.spp);
    CAPTURE(one.ratio);
    if (one.outside()) CHECK(one.flagged);
  }
}

}  // namespace tyndall::test::estimate_slow_test

#pragma once
#include "tests/support/light_tracer.h"
#include "tests/support/prepared.h"
#include "tests/support/statistics.h"

#include <vector>

/// Compares pictures of independent seeds, in the pixels that the light tracer can see.
namespace tyndall::test {

/// Independent pictures of one scene, 3 numbers a pixel.
using Pictures = std::vector<std::vector<double>>;

inline Pictures rendered(Scene scene, int spp, int seeds) {
  Pictures out;
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.render.seed = static_cast<std::uint32_t>(seed);
    const RenderResult result = render(compile(scene), {.spp = static_cast<std::uint32_t>(spp)});
    CHECK(totals(result.film).rejected == 0);
    const std::vector<float> picture = resolve(result.film);
    out.emplace_back(picture.begin(), picture.end());
  }
  return out;
}

/// Mean over those pixels of a rectangle that the light tracer can see.
struct Patch {
  int x0, y0, x1, y1;
};
inline double mean_of(const std::vector<double>& picture, const LightTraced& traced, Patch patch) {
  double sum = 0, count = 0;
  for (int y = patch.y0; y < patch.y1; ++y)
    for (int x = patch.x0; x < patch.x1; ++x) {
      const auto at = static_cast<std::size_t>(y * traced.width + x);
      if (!traced.joined[at]) continue;
      for (std::size_t channel = 0; channel < 3; ++channel) sum += picture[3 * at + channel];
      count += 3;
    }
  return count > 0 ? sum / count : 0;
}

/// Mean over all pixels that the light tracer can see, from independent pictures.
inline Estimate mean_of(const Pictures& pictures, const LightTraced& traced) {
  std::vector<double> means;
  for (const auto& picture : pictures) means.push_back(mean_of(picture, traced, {0, 0, traced.width, traced.height}));
  return estimate(means);
}

/// Mean over blocks of 8x8 pixels of the squared relative difference of two sets of pictures, as products of the
/// differences of their halves: those are independent, so noise alone averages to 0.
inline Estimate squared_bias(const Pictures& a, const Pictures& b, const LightTraced& traced) {
  const auto half_mean = [&](const Pictures& pictures, std::size_t half, Patch patch) {
    double sum = 0, count = 0;
    for (std::size_t i = half; i < pictures.size(); i += 2, ++count) sum += mean_of(pictures[i], traced, patch);
    return sum / count;
  };
  std::vector<double> products;
  for (int y = 0; y + 8 <= traced.height; y += 8)
    for (int x = 0; x + 8 <= traced.width; x += 8) {
      const Patch patch{x, y, x + 8, y + 8};
      const double level = (half_mean(b, 0, patch) + half_mean(b, 1, patch)) / 2;
      if (level <= 0) continue;
      const double first = half_mean(a, 0, patch) - half_mean(b, 0, patch);
      const double second = half_mean(a, 1, patch) - half_mean(b, 1, patch);
      products.push_back(first * second / (level * level));
    }
  return estimate(products);
}

}  // namespace tyndall::test

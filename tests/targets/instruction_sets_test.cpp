#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/prepared.h"
#include "tests/support/statistics.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace tyndall::test::instruction_sets_test {

namespace {

constexpr int edge = 48;

RenderScene small(const std::string& name, std::uint32_t seed) {
  Scene scene = small_scene(name, edge, edge, 4);
  scene.render.seed = seed;
  return compile(scene);
}

/// Means of the picture from samples first … last - 1.
std::vector<float> picture(const Kernels& kernels, const RenderScene& scene, std::uint32_t first, std::uint32_t last) {
  const Film film = drawn_by(kernels, scene, SceneViewOf(scene).view(), first, last);
  CHECK(totals(film).rejected == 0);
  return resolve(film);
}

/// Mean of a channel over a block of 8 x 8 pixels.
double block(const std::vector<float>& rgb, int index, std::size_t channel) {
  double sum = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const int pixel = (index / 6 * 8 + y) * edge + index % 6 * 8 + x;
      sum += static_cast<double>(rgb[static_cast<std::size_t>(pixel) * 3 + channel]) / 64;
    }
  return sum;
}

constexpr const char* scenes[] = {"showroom", "cornell-smoke", "cornell-box", "bouncing-spheres", "perlin-spheres"};

}  // namespace

TEST_CASE("instruction sets: the same samples give the same pixels, except where rounding changes a path's decision") {
  for (const std::string name : scenes) {
    const RenderScene scene = small(name, 0);
    const std::vector<float> plain = picture(scalar_kernels(), scene, 0, 1);
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<float> other = picture(kernels, scene, 0, 1);
      int different = 0;
      for (std::size_t i = 0; i < plain.size(); ++i)
        different += std::abs(plain[i] - other[i]) <= 0.03f * (plain[i] + 0.1f) ? 0 : 1;
      CAPTURE(name);
      CAPTURE(std::string(kernels.isa));
      CHECK(different <= 0.02 * static_cast<double>(plain.size()));
    }
  }
}

TEST_CASE("instruction sets: pictures of other seeds differ by their noise alone, block by block") {
  constexpr std::uint32_t batches = 16, samples = 4;
  for (const std::string name : tried(scenes, 2)) {
    const RenderScene scene = small(name, 1), other_scene = small(name, 2);
    std::vector<std::vector<float>> plain;
    for (std::uint32_t b = 0; b < batches; ++b)
      plain.push_back(picture(scalar_kernels(), scene, b * samples, (b + 1) * samples));
    for (const Kernels& kernels : available_kernels()) {
      std::vector<std::vector<float>> other;
      for (std::uint32_t b = 0; b < batches; ++b)
        other.push_back(picture(kernels, other_scene, b * samples, (b + 1) * samples));
      double squares = 0, sum = 0, worst = 0;
      int count = 0;
      for (int index = 0; index < 36; ++index) {
        std::vector<double> differences;
        for (std::size_t b = 0; b < batches; ++b)
          differences.push_back(block(plain[b], index, 1) - block(other[b], index, 1));
        const test::Estimate e = test::estimate(differences);
        if (e.error == 0) continue;  // the block has no noise, because all its samples are equal
        const double z = e.mean / e.error;
        squares += z * z, sum += z, worst = std::max(worst, std::abs(z));
        ++count;
      }
      CAPTURE(name);
      CAPTURE(std::string(kernels.isa));
      CHECK(count > 20);
      // Student's t with 15 degrees of freedom: variance 15/13, and 1 in 50,000 beyond 6.1.
      CHECK(std::abs(sum) < 4 * std::sqrt(count * 15.0 / 13));
      CHECK(std::abs(squares / count - 15.0 / 13) < 4 * std::sqrt(2.8 / count));
      CHECK(worst < 6.1);
    }
  }
}

TEST_CASE("instruction sets: pixels see the same elements first") {
  for (const std::string name : scenes) {
    const RenderScene scene = small(name, 0);
    const SceneViewOf view(scene);
    std::vector<FirstHit> plain(edge * edge), other(edge * edge);
    scalar_kernels().first_hits(view.view(), {0, 0, edge, edge}, plain.data());
    for (const Kernels& kernels : available_kernels()) {
      kernels.first_hits(view.view(), {0, 0, edge, edge}, other.data());
      int different = 0, colours = 0;
      for (std::size_t i = 0; i < plain.size(); ++i) {
        different += plain[i].element == other[i].element ? 0 : 1;
        colours += length(plain[i].albedo - other[i].albedo) < 0.03f ? 0 : 1;
      }
      CAPTURE(name);
      CHECK(different <= 1);
      CHECK(colours <= 2);
    }
  }
}

}  // namespace tyndall::test::instruction_sets_test

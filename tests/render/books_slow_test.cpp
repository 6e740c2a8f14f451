#include "tests/support/pictures.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

/// Means of the books' scenes, known from long renders of an independent program.
namespace tyndall::test::books_slow_test {

namespace {

struct Known {
  const char* name;
  double mean[3], tolerance;
};

/// Means of the three channels over `runs` seeds.
void check(const Known& known, Integrator integrator, const std::string& isa, int runs, std::uint32_t spp) {
  std::vector<double> means[3];
  for (int run = 0; run < runs; ++run) {
    Scene scene = small_scene(known.name, 256, 256, 1);
    scene.render.integrator = integrator;
    scene.render.seed = static_cast<std::uint32_t>(run);
    const std::vector<float> rgb = resolve(render(compile(scene), {.isa = isa, .spp = spp}).film);
    double sum[3] = {0, 0, 0};
    for (std::size_t i = 0; i < rgb.size(); ++i) sum[i % 3] += static_cast<double>(rgb[i]);
    for (int c = 0; c < 3; ++c) means[c].push_back(sum[c] / (256 * 256));
  }
  for (int c = 0; c < 3; ++c) {
    const Estimate e = estimate(means[c]);
    CAPTURE(known.name);
    CAPTURE(c);
    CAPTURE(e.mean);
    CAPTURE(e.error);
    CHECK(e.error < known.tolerance / 3);
    CHECK(std::abs(e.mean - known.mean[c]) < known.tolerance);
  }
}

constexpr Known box{"cornell-box", {0.1775, 0.1585, 0.1443}, 0.001};
constexpr Known smoke{"cornell-smoke", {0.5818, 0.5257, 0.4852}, 0.002};

}  // namespace

TEST_CASE("books: the mean of the Cornell box") { check(box, Integrator::path, "", 16, 40); }

TEST_CASE("books: the mean of the Cornell box of smoke") { check(smoke, Integrator::path, "", 16, 16); }

TEST_CASE("books: the same by light sampling") {
  for (const Integrator integrator : {Integrator::nee, Integrator::mis}) {
    check(box, integrator, "", 16, 16);
    check(smoke, integrator, "", 16, 16);
  }
}

TEST_CASE("books: the same by one path at a time") { check(smoke, Integrator::path, "scalar", 16, 16); }

}  // namespace tyndall::test::books_slow_test

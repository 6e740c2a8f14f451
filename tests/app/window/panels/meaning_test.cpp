#include "app/window/panels/rows.h"

#include "core/base/math.h"
#include "tests/support/metal_survival.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::meaning_test {

TEST_CASE("the light that fuzz loses is metal_survival averaged over the cosine") {
  for (const double fuzz : {0.05, 0.18, 0.5, 1.0}) {
    const int steps = 20000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
      const double cosine = (k + 0.5) / steps;
      sum += 2 * cosine * (1 - metal_survival(fuzz, cosine)) / steps;
    }
    CHECK(fuzz_loss(fuzz) == doctest::Approx(sum).epsilon(1e-4).scale(0));
  }
  CHECK(meaning(Metal<>{0.18}, "fuzz") == "0.3 % of the light lost below the surface");
  CHECK(meaning(Metal<>{0}, "fuzz") == "a perfect mirror");
}

TEST_CASE("the forward share is Henyey and Greenstein's density integrated over half of the directions") {
  for (const double g : {-0.8, -0.1, 0.0005, 0.3, 0.9}) {
    const int steps = 200000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) sum += 2 * pi * henyey_greenstein_pdf(g, (k + 0.5) / steps) / steps;
    CHECK(forward_fraction(g) == doctest::Approx(sum).epsilon(1e-4).scale(0));
  }
  CHECK(forward_fraction(0) == 0.5);
}

TEST_CASE("glass says what it reflects and where it reflects all") {
  CHECK(meaning(Dielectric<>{1.5}, "refractive_index") == "reflects 4.0 % head on, all beyond 41.8°");
  CHECK(meaning(Dielectric<>{1 / 1.5}, "refractive_index") == "reflects 4.0 %, all beyond 41.8° outside");
  CHECK(meaning(Dielectric<>{1}, "refractive_index") == "as the surroundings: invisible");
}

TEST_CASE("fog says how far light gets") {
  CHECK(meaning(Medium<>{1.1, 0}, "density") == "mean free path 0.909");
  CHECK(meaning(Medium<>{0, 0}, "density") == "empty: light passes");
  CHECK(meaning(Medium<>{1, 0}, "g") == "isotropic: scatters evenly");
  CHECK(meaning(Medium<>{1, 0.9}, "g").ends_with(" goes on forward"));
  CHECK(meaning(Medium<>{1, -0.9}, "g") == meaning(Medium<>{1, 0.9}, "g").substr(0, 4) + " goes back");
}

TEST_CASE("a disk says how long its half axes are and how wide its hole is") {
  const Disk<> ring{{0, 0, 0}, {3, 4, 0}, {0, 0, 0.5}, 0.25};
  CHECK(meaning(ring, "u") == "half axis of 5");
  CHECK(meaning(ring, "v") == "half axis of 0.5");
  CHECK(meaning(ring, "inner") == "a ring: the hole is 25 % as wide");
  CHECK(meaning(Disk<>{}, "inner") == "no hole");
  CHECK(meaning(ring, "center").empty());
}

TEST_CASE("the sharp range: its ends blur to one pixel") {
  Camera camera;
  camera.vfov = 30;
  camera.defocus_angle = 1;
  camera.focus_distance = 5;
  const SharpRange range = sharp_range(camera, 800);
  const double lens = 5 * std::tan(pi / 360), pixel = 2 * std::tan(15 * pi / 180) / 800;
  for (const double depth : {range.near, range.far}) {
    const double angle = 2 * lens * std::abs(1 / depth - 1 / 5.0);  // size of the blur disc, seen from the lens
    CHECK(angle == doctest::Approx(pixel).epsilon(1e-9).scale(0));
  }
  CHECK(range.near < 5);
  CHECK(range.far > 5);
  camera.defocus_angle = 1e-3;
  CHECK(std::isinf(sharp_range(camera, 800).far));
}

TEST_CASE("a full-frame lens of 24 mm sees 53 degrees") {
  Camera camera;
  camera.vfov = 53.13;
  CHECK(meaning(camera, "vfov") == "as a 24 mm lens on 35 mm film");
}

}  // namespace tyndall::test::meaning_test

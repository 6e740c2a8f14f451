#include "core/trace/sky.h"

#include "core/compile/columns.h"
#include "tests/support/skies.h"
#include "tests/support/statistics.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <array>
#include <numeric>

/// The sky's picture: where its texels lie, and that directions are drawn with the density that they are said to have.
namespace tyndall::test::sky_test {

namespace {

struct ViewedSky {
  SkyColumns columns;
  SkyView view;
  explicit ViewedSky(const SkyPicture& sky) : columns(sky_columns(sky, true, nullptr)), view(view_of(columns)) {}
  SkySample<float> towards(Vec3d direction) const { return sky_towards<float>(view, unit_vector(direction)); }
};

Vec3d direction_at(double u, double v) {
  const double theta = pi * (1 - v), phi = 2 * pi * (u - 0.5);
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

std::vector<SkyPicture> some_skies() {
  std::vector<SkyPicture> skies{uniform_sky(1, 1, 1),   random_sky(2, 1, 1),  random_sky(7, 5, 2),
                                random_sky(64, 32, 3),  random_sky(3, 90, 4), sunny_sky(1e6f),
                                sunny_sky(1e6f, 63, 0), sunny_sky(1e-6f)};
  skies[3].rotate_y = 130, skies[5].rotate_y = -77, skies[4].scale = 1e-12;
  return skies;
}

template <class F>
std::size_t octant_of(Vec3<F> d) {
  return (d.x > 0 ? 1u : 0u) + (d.y > 0 ? 2u : 0u) + (d.z > 0 ? 4u : 0u);
}

/// By octant: the integral of the luminance over directions.
using OctantLight = std::array<double, 8>;

OctantLight light_by_octant(const ViewedSky& viewed) {
  OctantLight light{};
  const int rows = thorough() ? 720 : 360, columns = 2 * rows;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double v = (y + 0.5) / rows;
      const Vec3d d = direction_at((x + 0.5) / columns, v);
      const auto luminance = static_cast<double>(sky_luminance(viewed.towards(d).radiance, 1.0f));
      light[octant_of(d)] += luminance * std::sin(pi * v) * 2 * pi * pi / rows / columns;
    }
  return light;
}

}  // namespace

TEST_CASE("sky: the middle is towards -z, +x is to its right, the first row is up; rotate_y turns as objects do") {
  std::vector<float> rgb;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) rgb.insert(rgb.end(), {static_cast<float>(x), static_cast<float>(y), 1});
  SkyPicture sky = sky_of(4, 3, rgb);
  const auto red_and_green = [&](Vec3d direction, float red, float green) {
    const Vec3f seen = ViewedSky(sky).towards(direction).radiance;
    CHECK(seen.x == doctest::Approx(red).epsilon(1e-4));
    CHECK(seen.y == doctest::Approx(green).epsilon(1e-4));
  };
  red_and_green({0, 0, -1}, 1.5f, 1);  // between the two columns in the middle
  red_and_green({1, 0, 0}, 2.5f, 1);
  red_and_green({-1, 0, 0}, 0.5f, 1);
  red_and_green({0, 0, 1}, 1.5f, 1);  // where the picture closes: between its last column and its first
  CHECK(ViewedSky(sky).towards({0, 1, 0}).radiance.y == 0);
  CHECK(ViewedSky(sky).towards({0, -1, 0}).radiance.y == 2);
  sky.rotate_y = 90;  // x' = z: what was towards -z is towards -x
  red_and_green({-1, 0, 0}, 1.5f, 1);
  red_and_green({0, 0, -1}, 2.5f, 1);
  sky.scale = 3;
  CHECK(ViewedSky(sky).towards({0, 0, -1}).radiance.z == doctest::Approx(3));
}

TEST_CASE("sky: the pdf integrates to 1, and is 0 only where the sky is black") {
  for (const SkyPicture& sky : some_skies()) {
    const ViewedSky viewed(sky);
    CAPTURE(sky.pixels->width);
    CAPTURE(sky.pixels->largest);
    const int fine = thorough() ? 2 : 1;
    const int rows = viewed.view.rows * 5 * fine,
              columns = viewed.view.width * (1 + 500 * fine * fine / viewed.view.width);
    double integral = 0;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const double v = (y + 0.5) / rows, sine = std::sin(pi * v);
        const SkySample<float> seen = viewed.towards(direction_at((x + 0.5) / columns, v));
        integral += static_cast<double>(seen.pdf) * sine;
        if (seen.pdf <= 0) REQUIRE(max_component(seen.radiance) <= 1e-6f * viewed.columns.scale * sky.pixels->largest);
      }
    CHECK(integral * 2 * pi * pi / rows / columns == doctest::Approx(1).epsilon(2e-3));
  }
}

TEST_CASE("sky: the pdf goes on evenly across the columns of a row, also where the picture closes") {
  const ViewedSky viewed(random_sky(7, 5, 2));
  for (int column = 0; column < viewed.view.width; ++column)
    for (const double v : {0.15, 0.4, 0.8}) {
      const double border = (column + 0.5) / viewed.view.width;
      const auto pdf = [&](double u) { return viewed.towards(direction_at(u, v)).pdf; };
      CHECK(pdf(border - 1e-5) == doctest::Approx(pdf(border + 1e-5)).epsilon(0.01).scale(0));
    }
}

TEST_CASE("sky: drawn directions have that density, and each part of the sky is drawn as often as it says") {
  for (const SkyPicture& sky : some_skies()) {
    const ViewedSky viewed(sky);
    const OctantLight exact = light_by_octant(viewed);
    for (const SamplerKind kind : {SamplerKind::random, SamplerKind::sobol}) {
      CAPTURE(sky.pixels->width);
      CAPTURE(sky.pixels->height);
      CAPTURE(sky.pixels->largest);
      const std::uint32_t drawn = thorough() ? 100000 : 20000;
      Moments light[8];  // by octant: the integral of the luminance
      std::uint32_t differing = 0;
      for (std::uint32_t i = 0; i < drawn; ++i) {
        const auto sampler = Sampler<float>::of(1, 3 + (i >> 8), 4, i & 255u, kind);
        const SkySample<float> s = sample_sky(viewed.view, sampler, sampler.next_2d(dimension::light_point));
        REQUIRE(s.pdf > 0);
        REQUIRE(std::abs(length(s.direction) - 1) < 1e-5f);
        const SkySample<float> again = sky_towards<float>(viewed.view, s.direction);
        differing += std::abs(again.pdf - s.pdf) <= 2e-3f * s.pdf ? 0 : 1;
        const std::size_t octant = octant_of(s.direction);
        const double weight = static_cast<double>(sky_luminance(s.radiance, 1.0f)) / static_cast<double>(s.pdf);
        for (std::size_t k = 0; k < 8; ++k) light[k].add(k == octant ? weight : 0);
      }
      CHECK(differing < drawn / 200);  // places whose rounding puts them into another cell
      const double total = std::accumulate(exact.begin(), exact.end(), 0.0);
      for (std::size_t k = 0; k < 8; ++k) {
        const Estimate e = light[k].estimate();
        CHECK(std::abs(e.mean - exact[k]) <= 4.5 * e.error + 1e-3 * exact[k] + 1e-6 * total);
      }
    }
  }
}

TEST_CASE("sky: the dark texels beside a sun of a million times their radiance are drawn in their share") {
  const ViewedSky viewed(sunny_sky(1e6f));
  const SkyDistribution& d = *viewed.columns.distribution;
  const std::size_t stride = 65, row = 9 * 2;
  for (std::size_t x = 0; x < 64; ++x) CHECK(d.column_ends[row * stride + x] < d.column_ends[row * stride + x + 1]);
  CHECK(d.column_ends[row * stride + 64] == SkyDistribution::draws);
  CHECK(d.row_ends[0] == 0);
  CHECK(d.row_ends.back() == SkyDistribution::draws);
  CHECK(d.spread < 1e-3);
  CHECK(ViewedSky(uniform_sky(16, 8, 5)).columns.distribution->spread == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("sky: a black one is no light; another scale or turn keeps the distribution, another picture does not") {
  CHECK(!ViewedSky(uniform_sky(4, 2, 0)).view.sampled);
  SkyPicture sky = random_sky(8, 4, 5);
  const SkyColumns before = sky_columns(sky, true, nullptr);
  sky.rotate_y = 20, sky.scale = 2;
  CHECK(sky_columns(sky, true, &before).distribution == before.distribution);
  CHECK(sky_columns(sky, true, &before).irradiance == 2 * before.irradiance);
  CHECK(sky_columns(random_sky(8, 4, 6), true, &before).distribution != before.distribution);
  CHECK(!sky_columns(sky, false, nullptr).is_sampled());
}

TEST_CASE("sky: turns as objects do, and exactly by right angles") {
  SkyPicture sky = uniform_sky(4, 2, 1);
  sky.rotate_y = 90;
  CHECK(sky_columns(sky, true, nullptr).cos == 0);
  CHECK(sky_columns(sky, true, nullptr).sin == 1);
  sky.rotate_y = 30;
  CHECK(sky_columns(sky, true, nullptr).sin == doctest::Approx(0.5));
}

}  // namespace tyndall::test::sky_test

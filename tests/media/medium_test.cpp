#include "core/media/medium.h"
#include "tests/support/directions.h"
#include "tests/support/event.h"

#include <doctest/doctest.h>

namespace tyndall::test::medium_test {

namespace {

/// P(cosine <= c) of Henyey and Greenstein's law, g != 0: its density integrated.
double cumulative_cosine(double g, double c) {
  return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * c) - 1 / (1 + g));
}

/// Means of the cosine's Legendre polynomials over evenly spaced u, which have no noise.
struct CosineMoments {
  double mean = 0, legendre2 = 0, minimum = 2, maximum = -2;
};
template <class F>
CosineMoments cosine_moments(double g, int count) {
  CosineMoments m;
  for (int i = 0; i < count; ++i) {
    const F u = static_cast<F>((i + 0.5) / count);
    const auto c = static_cast<double>(henyey_greenstein_cosine(static_cast<F>(g), u));
    m.mean += c / count;
    m.legendre2 += (1.5 * c * c - 0.5) / count;
    m.minimum = std::min(m.minimum, c), m.maximum = std::max(m.maximum, c);
  }
  return m;
}

}  // namespace

TEST_CASE("medium: free flights follow the exponential law, in every stream") {
  std::uint32_t number = 0;
  for (const double density : {1.0, 1e-3, 1e4})
    for (const std::uint32_t stream : {0u, 3u}) {
      Moments length, square;
      std::vector<double> flights;
      for (int i = 0; i < 500000; ++i) {
        const float u = sampler<float>(number++).open(dimension::free_flight, stream);
        const auto t = static_cast<double>(free_flight(static_cast<float>(density), u));
        REQUIRE(t >= 0);
        REQUIRE(std::isfinite(t));
        length.add(t), square.add(t * t);
        flights.push_back(t);
      }
      ZScores scores;
      scores.add("mean", length.estimate(), 1 / density);
      scores.add("mean square", square.estimate(), 2 / (density * density));
      CHECK(kolmogorov_smirnov(flights, [&](double t) { return 1 - std::exp(-density * t); }) < 2.23);
    }
}

TEST_CASE("medium: the generator's extreme numbers give finite flights; long flights are not cut short") {
  const float minimum = unit_interval_open<float>(0u), maximum = unit_interval_open<float>(0xffffffffu);
  CHECK(minimum > 0.0f);
  CHECK(maximum == 1.0f);
  CHECK(free_flight(1.0f, maximum) == 0.0f);
  CHECK(free_flight(1.0f, minimum) > 22.0f);  // mean free paths: 2^-32 of all flights go farther
  CHECK(std::isfinite(free_flight(1e-30f, minimum)));
}

TEST_CASE("medium: transmittance is Beer's and Lambert's law") {
  CHECK(transmittance(0.0f) == 1.0f);
  for (const double depth : {1e-6, 0.01, 0.5, 1.0, 5.0, 20.0})
    CHECK(transmittance(static_cast<float>(depth)) == doctest::Approx(std::exp(-depth)).epsilon(1e-6).scale(0));
  CHECK(transmittance(1e6f) < 1e-30f);
}

TEST_CASE("henyey-greenstein: cosines stay cosines and keep their mean down to g = 0 and up to 0.9999") {
  for (const double size :
       {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.4999, 0.5, 0.5001, 0.9, 0.99, 0.999, 0.9999})
    for (const double g : {size, -size}) {
      CAPTURE(g);
      const CosineMoments m = cosine_moments<float>(g, 200000);
      const CosineMoments exact = cosine_moments<double>(g, 200000);
      CHECK(exact.mean == doctest::Approx(g).epsilon(1e-5).scale(1e-3));
      CHECK(exact.legendre2 == doctest::Approx(g * g).epsilon(1e-4).scale(1e-3));
      CHECK(m.minimum >= -1);
      CHECK(m.maximum <= 1);
      CHECK(std::abs(m.mean - static_cast<double>(static_cast<float>(g))) < 2e-6);
      CHECK(std::abs(m.legendre2 - g * g) < 2e-5);
    }
}

TEST_CASE("henyey-greenstein: the inverse has the law's distribution, whose density integrates to 1") {
  for (const double g : {-0.9, -0.3, 0.2, 0.75, 0.95}) {
    CAPTURE(g);
    for (const float u : {0.01f, 0.2f, 0.5f, 0.8f, 0.99f}) {
      const auto c = static_cast<double>(henyey_greenstein_cosine(static_cast<float>(g), u));
      CHECK(cumulative_cosine(g, c) == doctest::Approx(static_cast<double>(u)).epsilon(2e-5));
    }
    const auto around = [&](double c) { return 2 * pi * henyey_greenstein_pdf(g, c); };
    CHECK(integrate(around, -1, 1, 20000) == doctest::Approx(1).epsilon(1e-6).scale(0));
    CHECK(integrate([&](double c) { return around(c) * c; }, -1, 1, 20000) ==
          doctest::Approx(g).epsilon(1e-6).scale(0));
    CHECK(integrate(around, -1, 0.3) == doctest::Approx(cumulative_cosine(g, 0.3)).epsilon(1e-6).scale(0));
  }
  CHECK(henyey_greenstein_pdf(0.0, 0.7) == doctest::Approx(0.25 / pi));
}

TEST_CASE("henyey-greenstein: directions are as dense as the phase function says, which integrates to 1") {
  Directions directions;
  for (const double g : {0.0, 1e-7, 0.3, -0.6, 0.9}) {
    CAPTURE(g);
    const auto direction = directions.next<double>();
    CapCells cap(direction, 2);
    constexpr int drawn = 200000;
    for (std::uint32_t i = 0; i < drawn; ++i) {
      const Pair<double> u = sampler<double>(i).next_2d(dimension::direction);
      const Vec3d out = scatter_in_medium(g, direction, on_sphere(u), u);
      REQUIRE(std::abs(length(out) - 1) < 1e-12);
      cap.count(out);
    }
    const auto fraction =
        cap.integrate([&](Vec3d d) { return henyey_greenstein_pdf(g, dot(direction, d)); }, g > 0.8 ? 250 : 60);
    CHECK(sum(fraction) == doctest::Approx(1).epsilon(1e-3).scale(0));
    CHECK(std::abs(cap.deviate(fraction, drawn)) < 4.5);
  }
}

}  // namespace tyndall::test::medium_test

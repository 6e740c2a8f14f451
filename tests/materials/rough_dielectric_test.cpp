#include "tests/materials/rough_dielectric.h"

#include "tests/support/directions.h"

#include <doctest/doctest.h>

/// The contract of core/materials/bsdf.h, held by a material whose samples have weights other than 1.
namespace tyndall::test::rough_dielectric_test {

namespace {

/// Integrals of a function of the direction over the two sides of the surface: x above, y below. Below it jumps where
/// the facet that would refract light there is at right angles to the surface.
template <class Function>
Pair<double> integrals(const GroundGlass& row, const Function& f) {
  const double eta = row.leaving ? 1 / 1.5 : 1.5, jump = std::min(std::cos(row.angle) / eta, 1.0);
  const auto at_height = [&](double z) {
    constexpr int points = 240;
    const double sine = std::sqrt(1 - z * z);
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double phi = 2 * pi * (i + 0.5) / points;
      sum += 2 * pi / points * f(Vec3d{sine * std::cos(phi), sine * std::sin(phi), z});
    }
    return sum;
  };
  return {integrate(at_height, 0, 1, 100), integrate(at_height, -1, -jump, 100) + integrate(at_height, -jump, 0, 100)};
}

}  // namespace

TEST_CASE("rough dielectric: directions are drawn with the density of pdf(), which integrates to 1 with what is lost") {
  ZScores lost;
  for (const GroundGlass& row : ground_glasses) {
    if (row.roughness < 0.4) continue;  // too narrow for these cells
    CAPTURE(row.roughness);
    CAPTURE(row.angle);
    CAPTURE(row.leaving);
    const RoughDielectric<double> glass{row.roughness};
    CapCells sphere(up<double>, 2);
    constexpr int drawn = 200000;
    Moments absorbed;
    for (std::uint32_t i = 0; i < drawn; ++i) {
      const BsdfSample<double> out = sample(glass, event_of(row, i));
      absorbed.add(out.flags.absorbed ? 1 : 0);
      if (!out.flags.absorbed) sphere.count(out.direction);
    }
    const Incident<double> in = event_of(row, 0);
    const auto pdf_at = [&](Vec3d l) { return pdf(glass, in, l); };
    const Pair<double> fraction = integrals(row, pdf_at);
    CHECK(fraction.x + fraction.y + row.lost == doctest::Approx(1).epsilon(1e-4).scale(0));
    CHECK(std::abs(sphere.deviate(sphere.integrate(pdf_at), drawn)) < 4.5);
    lost.add("lost", absorbed.estimate(), row.lost, 0.03);
  }
}

TEST_CASE("rough dielectric: the weight of each sample is eval over pdf, not 1, and never above 1") {
  double minimum = 1;
  for (const GroundGlass& row : ground_glasses) {
    const RoughDielectric<double> glass{row.roughness};
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const Incident<double> in = event_of(row, i);
      const BsdfSample<double> out = sample(glass, in);
      if (out.flags.absorbed) continue;
      REQUIRE(out.flags.transmitted == (out.direction.z < 0));
      REQUIRE(length(out.direction) == doctest::Approx(1).epsilon(1e-12).scale(0));
      REQUIRE(out.pdf == doctest::Approx(pdf(glass, in, out.direction)));
      REQUIRE(out.weight == doctest::Approx(eval(glass, in, out.direction) / out.pdf).epsilon(1e-6).scale(0));
      REQUIRE(out.weight <= 1);
      minimum = std::min(minimum, out.weight);
    }
  }
  CHECK(minimum < 0.3);
}

TEST_CASE("rough dielectric: a furnace loses what meets a second facet and no more") {
  ZScores means;
  for (const GroundGlass& row : ground_glasses) {
    CAPTURE(row.roughness);
    CAPTURE(row.angle);
    CAPTURE(row.leaving);
    const RoughDielectric<double> glass{row.roughness};
    Moments weight;
    for (std::uint32_t i = 0; i < 100000; ++i) {
      const BsdfSample<double> out = sample(glass, event_of(row, i));
      weight.add(out.flags.absorbed ? 0 : out.weight);
    }
    means.add("weight", weight.estimate(), row.reflected + row.refracted);
    CHECK(row.reflected + row.refracted <= 1 - row.lost);
    if (row.roughness < 0.4) continue;
    const Incident<double> in = event_of(row, 0);
    const Pair<double> fraction = integrals(row, [&](Vec3d l) { return eval(glass, in, l); });
    CHECK(fraction.x == doctest::Approx(row.reflected).epsilon(1e-4).scale(0));
    CHECK(fraction.y == doctest::Approx(row.refracted).epsilon(1e-4).scale(0));
  }
}

TEST_CASE("rough dielectric: f(a, b) is f(b, a) times the square of the index on the side of b over that of a") {
  Directions directions;
  int through = 0, reflected = 0;
  for (const double index : {1.5, 1 / 1.5, 2.4})
    for (int i = 0; i < 20000; ++i) {
      const RoughDielectric<double> glass{0.5, index};
      const Vec3d a = directions.next<double>(), b = directions.next<double>();
      const Incident<double> from_a = event(sampler<double>(0), -a, up<double>);
      const Incident<double> from_b = event(sampler<double>(0), -b, up<double>);
      const double there = eval(glass, from_a, b) / std::abs(b.z), back = eval(glass, from_b, a) / std::abs(a.z);
      const double factor = a.z * b.z > 0 ? 1 : b.z < 0 ? index * index : 1 / (index * index);
      REQUIRE(there == doctest::Approx(factor * back).epsilon(1e-6).scale(1e-3));
      if (there > 0) ++(a.z * b.z > 0 ? reflected : through);
    }
  CHECK(reflected > 20000);
  CHECK(through > 5000);
}

TEST_CASE("rough dielectric: polished it is smooth glass") {
  for (const bool leaving : {false, true})
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const Incident<double> in = event_of({1e-6, 0.5, leaving, 0, 0, 0}, i);
      const BsdfSample<double> rough = sample(RoughDielectric<double>{1e-6}, in);
      const BsdfSample<double> smooth = sample(Dielectric<double>{1.5}, in);
      if (rough.flags.transmitted != smooth.flags.transmitted) continue;  // a draw that is as large as Fresnel's share
      REQUIRE(length(rough.direction - smooth.direction) < 1e-2);
    }
}

}  // namespace tyndall::test::rough_dielectric_test

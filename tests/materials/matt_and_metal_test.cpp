#include "core/materials/lambertian.h"
#include "core/materials/light.h"
#include "core/materials/metal.h"
#include "tests/support/directions.h"
#include "tests/support/event.h"
#include "tests/support/metal_survival.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

/// Matt surfaces and metal: where light goes, how much of it, and that its density is the stated one.
namespace tyndall::test::matt_and_metal_test {

namespace {

template <class F>
void check_cosine_law(std::uint32_t count) {
  Directions directions;
  for (const bool from_behind : {false, true}) {
    std::vector<double> azimuths, squares;
    const Vec3<F> normal = directions.next<F>(), direction = directions.at_angle(normal, from_behind ? 0.5 : 2.5);
    const Vec3<F> facing = from_behind ? -normal : normal;
    const Basis<F> basis = basis_around(facing);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Sampler<F> d = sampler<F>(i + (from_behind ? count : 0));
      const BsdfSample<F> out = sample(Lambertian<F>{}, event(d, direction, normal));
      REQUIRE_FALSE(out.flags.absorbed);
      REQUIRE_FALSE(out.flags.transmitted);
      const auto c = static_cast<double>(dot(out.direction, facing));
      REQUIRE(c >= -1e-6);
      REQUIRE(std::abs(static_cast<double>(length(out.direction)) - 1) < 4e-7);
      const double x = static_cast<double>(dot(out.direction, basis.s));
      const double y = static_cast<double>(dot(out.direction, basis.t));
      const double angle = std::atan2(y, x);
      azimuths.push_back(angle / (2 * pi) + 0.5), squares.push_back(c * c);
    }
    CHECK(kolmogorov_smirnov(azimuths, [](double t) { return t; }) < 2.23);
    CHECK(kolmogorov_smirnov(squares, [](double c2) { return c2; }) < 2.23);
  }
}

}  // namespace

TEST_CASE("lambertian: density cos/pi on the side where the light comes from") {
  check_cosine_law<float>(500000);
  check_cosine_law<double>(500000);
}

TEST_CASE("lambertian: where the unit vector cancels the normal, the direction is the normal") {
  const Sampler<float> d = sampler<float>(1);
  Incident<float> in = event(d, down_at<float>(0.3), up<float>);
  in.unit_vector = {0, 0, -1};
  CHECK(sample(Lambertian<float>{}, in).direction == up<float>);
  in.unit_vector = {1e-8f, 0, -1};
  CHECK(sample(Lambertian<float>{}, in).direction == up<float>);
}

TEST_CASE(
    "lambertian: around the point where they cancel, unit directions above the surface; elsewhere never the normal") {
  Directions directions;
  int fallbacks = 0, naive = 0;
  for (std::uint32_t i = 0; i < 200000; ++i) {
    const Vec3f normal = directions.next<float>(), direction = directions.at_angle(normal, 2.5);
    const Sampler<float> d = sampler<float>(i);
    Incident<float> in = event(d, direction, normal);
    fallbacks += sample(Lambertian<float>{}, in).direction == in.facing ? 1 : 0;
    in.unit_vector = directions.at_angle(-in.facing, std::pow(10.0, -static_cast<int>(i % 10)));
    const Vec3f out = sample(Lambertian<float>{}, in).direction, sum = in.facing + in.unit_vector;
    REQUIRE(std::abs(length(out) - 1) < 4e-7f);
    REQUIRE(dot(out, in.facing) >= 0.0f);
    naive += std::isfinite(normalize(sum).x) && dot(normalize(sum), in.facing) >= 0.0f ? 0 : 1;
  }
  CHECK(fallbacks == 0);
  CHECK(naive > 1000);  // the plain sum is no number there, or points below the surface
}

namespace {

constexpr double angles[6] = {0, 30, 60, 80, 85, 89};
struct Row {
  double fuzz, survive[6];
};
constexpr Row rows[] = {
    {0.1, {1, 1, 1, 1, 0.9881566243290762, 0.6295641064729578}},
    {0.3, {1, 1, 1, 0.8856377288877171, 0.7117593033032801, 0.5435817960262953}},
    {0.5, {1, 1, 1, 0.75, 0.6294095225512604, 0.5261679781214721}},
    {1.0, {1, 0.9871392896287468, 0.84375, 0.6289270999376484, 0.5652012956144652, 0.5130879758861561}}};

}  // namespace

TEST_CASE("metal: the share that leaves, for a blur within the ball") {
  ZScores scores;
  for (const Row& row : rows)
    for (int k = 0; k < 6; ++k) {
      const double angle = angles[k] * degrees;
      CHECK(metal_survival(row.fuzz, std::cos(angle)) == doctest::Approx(row.survive[k]).epsilon(1e-7).scale(0));
      Moments survived;
      const Vec3f down = down_at<float>(angle);
      for (std::uint32_t i = 0; i < 250000; ++i) {
        const Sampler<float> d = sampler<float>(i + 250000u * static_cast<std::uint32_t>(k));
        const BsdfSample<float> out = sample(Metal<float>{static_cast<float>(row.fuzz)}, event(d, down, up<float>));
        REQUIRE_FALSE(out.flags.transmitted);
        REQUIRE(out.flags.absorbed == (out.direction.z <= 0));
        survived.add(out.flags.absorbed ? 0 : 1);
      }
      scores.add("survival", survived.estimate(), row.survive[k], 2e-3);
    }
}

TEST_CASE("metal: without fuzz a mirror, from both sides") {
  Directions directions;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Vec3f normal = directions.next<float>(), direction = directions.next<float>();
    const Sampler<float> d = sampler<float>(i);
    const BsdfSample<float> out = sample(Metal<float>{0.0f}, event(d, direction, normal));
    REQUIRE_FALSE(out.flags.absorbed);
    REQUIRE(dot(out.direction, normal) == doctest::Approx(-dot(direction, normal)).epsilon(1e-5));
    const Vec3f along_surface = cross(normal, out.direction) - cross(normal, direction);
    REQUIRE(length(along_surface) < 1e-6f);
  }
}

TEST_CASE("light: a path ends at a lamp") {
  const Sampler<float> d = sampler<float>(1);
  CHECK(sample(Light<float>{}, event(d, down_at<float>(0.3), up<float>)).flags.absorbed);
}

namespace {

template <class M>
void check(const M& material, double angle, Vec3d axis, double width, double leaving) {
  const Vec3d down = down_at<double>(angle);
  CapCells cap(axis, width);
  constexpr int drawn = 200000;
  for (std::uint32_t i = 0; i < drawn; ++i) {
    const Sampler<double> d = sampler<double>(i);
    const BsdfSample<double> out = sample(material, event(d, down, up<double>));
    if (out.flags.absorbed) continue;
    REQUIRE(out.pdf == doctest::Approx(pdf(material, event(d, down, up<double>), out.direction)));
    cap.count(out.direction);
  }
  const Sampler<double> any = sampler<double>(0);
  const Incident<double> in = event(any, down, up<double>);
  const auto fraction = cap.integrate([&](Vec3d direction) { return pdf(material, in, direction); }, 60);
  CHECK(cap.outside() == 0);
  CHECK(sum(fraction) == doctest::Approx(leaving).epsilon(1e-3).scale(0));
  CHECK(std::abs(cap.deviate(fraction, drawn)) < 4.5);
}

}  // namespace

TEST_CASE("density: lambertian") { check(Lambertian<double>{}, 0.4, up<double>, 1, 1); }

TEST_CASE("density: metal, narrow and wide, straight and where part of the blur is below the surface") {
  for (const double fuzz : {0.01, 0.3, 1.0})
    for (const double angle : {0.0, 0.7, 1.3, 1.5}) {
      CAPTURE(fuzz);
      CAPTURE(angle);
      const Vec3d down = down_at<double>(angle);
      check(Metal<double>{fuzz}, angle, {down.x, 0, -down.z}, 1 - std::sqrt(1 - fuzz * fuzz),
            metal_survival(fuzz, std::cos(angle)));
    }
}

}  // namespace tyndall::test::matt_and_metal_test

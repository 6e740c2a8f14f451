#include "core/materials/lambertian.h"
#include "tests/support/event.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

namespace tyndall::test::lambertian_test {

namespace {

template <class F>
void check_cosine_law(std::uint32_t count) {
  ZScores scores;
  Directions directions;
  for (const bool from_behind : {false, true}) {
    Moments cosine, cosine2, around_cos, around_sin, around_cos2;
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
      cosine.add(c), cosine2.add(c * c);
      around_cos.add(std::cos(angle)), around_sin.add(std::sin(angle)), around_cos2.add(std::cos(2 * angle));
      azimuths.push_back(angle / (2 * pi) + 0.5), squares.push_back(c * c);
    }
    scores.add("mean cosine", cosine.estimate(), 2.0 / 3, 1e-3);  // 4/5 for the books' old density 2 cos^3/π
    scores.add("mean square", cosine2.estimate(), 0.5, 1e-3);
    for (const Moments& m : {around_cos, around_sin, around_cos2})
      CHECK(std::abs(m.estimate().mean) <= 4 * m.estimate().error);
    CHECK(kolmogorov_smirnov(azimuths, [](double t) { return t; }) < 2.23);
    CHECK(kolmogorov_smirnov(squares, [](double c2) { return c2; }) < 2.23);
  }
}

}  // namespace

TEST_CASE("lambertian: density cos/pi on the side where the light comes from") {
  check_cosine_law<float>(500000);
  check_cosine_law<double>(500000);
}

TEST_CASE("lambertian: from one disc to a smaller one above it") {
  // Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-41: radii 1 and 1/2, 2 apart.
  Moments reached;
  for (std::uint32_t i = 0; i < 1000000; ++i) {
    const Sampler<float> d = sampler<float>(i);
    const Pair<float> from = in_disc(d.next_2d(dimension::light_point));
    const Vec3f direction = sample(Lambertian<float>{}, event(d, down_at<float>(0.3), up<float>)).direction;
    const float t = 2 / direction.z, x = from.x + t * direction.x, y = from.y + t * direction.y;
    reached.add(x * x + y * y < 0.25f ? 1 : 0);
  }
  ZScores scores;
  scores.add("discs", reached.estimate(), 0.04805898398896202, 5e-3);
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

}  // namespace tyndall::test::lambertian_test

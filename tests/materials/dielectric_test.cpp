#include "core/materials/dielectric.h"
#include "tests/support/event.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

namespace tyndall::test::dielectric_test {

namespace {

double length_error(Vec3f v) {
  const Vec3d w{v.x, v.y, v.z};
  return std::abs(length(w) - 1);
}

/// The books' refraction on leaving glass (Ray Tracing in One Weekend, section 11.2), without its fabs. Tells whether
/// it takes the root of a negative number for a ray that passes the books' test for total reflection.
bool root_of_negative(Vec3f direction, Vec3f normal, float index) {
  const float cosine = std::min(dot(direction, normal), 1.0f), sine = std::sqrt(1.0f - cosine * cosine);
  if (index * sine > 1.0f) return false;
  const Vec3f across = index * point_at(direction, -cosine, normal);
  return 1.0f - dot(across, across) < 0.0f;
}

/// Angle to the normal by Snell's law; the larger index is `index`.
double snell(double angle, double eta) { return std::asin(std::sin(angle) / eta); }

}  // namespace

TEST_CASE("dielectric: refracts by Snell's law, reflects by the mirror's, in the share of Fresnel") {
  ZScores scores;
  std::uint32_t event_number = 0;
  for (const double index : {1.333, 1.5, 2.417, 1 / 1.5})
    for (const double angle : {0.0, 20.0, 40.0, 60.0, 80.0})
      for (const bool leaving : {false, true}) {
        const double eta = leaving ? 1 / index : index, cosine = std::cos(angle * degrees);
        const Vec3d normal = leaving ? -up<double> : up<double>, down = down_at<double>(angle * degrees);
        Moments reflected;
        for (int i = 0; i < 40000; ++i) {
          const Sampler<double> d = sampler<double>(event_number++);
          const BsdfSample<double> out = sample(Dielectric<double>{index}, event(d, down, normal));
          REQUIRE_FALSE(out.flags.absorbed);
          reflected.add(out.flags.transmitted ? 0 : 1);
          const double sine = out.flags.transmitted ? std::sin(snell(angle * degrees, eta)) : std::sin(angle * degrees);
          REQUIRE(out.direction.x == doctest::Approx(sine).epsilon(1e-12));
          REQUIRE(std::abs(out.direction.y) < 1e-15);
          REQUIRE((out.direction.z < 0) == out.flags.transmitted);
          REQUIRE(length(out.direction) == doctest::Approx(1).epsilon(1e-14).scale(0));
        }
        scores.add("reflected share", reflected.estimate(), fresnel(cosine, eta), 0.2);
      }
}

TEST_CASE("dielectric: near critical angles and at normal incidence every direction is a unit vector") {
  Directions directions;
  int rays = 0, naive = 0;
  for (const float index : {1.000001f, 1.1f, 1.333f, 1.5f, 2.5f}) {
    const double critical = std::asin(1 / static_cast<double>(index));
    for (const double off : {0.0, 1e-8, -1e-8, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-5, -critical})
      for (std::uint32_t i = 0; i < 20000; ++i, ++rays) {
        const Vec3f normal = directions.next<float>(), direction = directions.at_angle(normal, critical + off);
        const Sampler<float> d = sampler<float>(i);
        naive += root_of_negative(direction, normal, index) ? 1 : 0;
        const BsdfSample<float> out = sample(Dielectric<float>{index}, event(d, direction, normal));
        REQUIRE(length_error(out.direction) < 4e-7);  // also fails for what is not a number
        if (out.flags.transmitted) REQUIRE(dot(out.direction, normal) >= 0.0f);
        if (off > 1e-6 && index > 1.001f) REQUIRE_FALSE(out.flags.transmitted);
      }
  }
  CHECK(rays == 1000000);
  CHECK(naive > rays / 50);
}

TEST_CASE("dielectric: matched to its surroundings it is not there, to the last bit, also at grazing incidence") {
  Directions directions;
  for (const double angle : {0.0, 0.5, 1.5, 1.5707, 1.570796, 1.57079632, pi / 2})
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const Vec3f normal = directions.next<float>(),
                  direction = directions.at_angle(normal, i % 2 ? angle : pi - angle);
      const Sampler<float> d = sampler<float>(i);
      const BsdfSample<float> out = sample(Dielectric<float>{1.0f}, event(d, direction, normal));
      REQUIRE(out.flags.transmitted);
      REQUIRE(out.direction == direction);
    }
}

TEST_CASE("dielectric: a bubble is glass seen from the other side") {
  Directions directions;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Vec3f normal = directions.next<float>(), direction = directions.next<float>();
    const Sampler<float> d = sampler<float>(i);
    const BsdfSample<float> inward = sample(Dielectric<float>{1.5f}, event(d, direction, -normal));
    const BsdfSample<float> relative = sample(Dielectric<float>{1 / 1.5f}, event(d, direction, normal));
    REQUIRE(inward.flags.transmitted == relative.flags.transmitted);
    REQUIRE(inward.direction == relative.direction);
  }
}

TEST_CASE("dielectric: an enormous index is a mirror, a tiny one reflects all but the straight ray") {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const Sampler<float> d = sampler<float>(i);
    const Vec3f slanted = down_at<float>(0.6);
    const BsdfSample<float> mirror = sample(Dielectric<float>{1e15f}, event(d, slanted, up<float>));
    CHECK(mirror.direction.z == doctest::Approx(-slanted.z));
    CHECK_FALSE(sample(Dielectric<float>{1e-6f}, event(d, slanted, up<float>)).flags.transmitted);
  }
}

TEST_CASE("dielectric: the books' rule is used where it is asked for") {
  const Vec3d down = down_at<double>(80 * degrees);
  Moments reflected;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Sampler<double> d = sampler<double>(i);
    Incident<double> in = event(d, down, up<double>);
    in.schlick = true;
    reflected.add(sample(Dielectric<double>{1.5}, in).flags.transmitted ? 0 : 1);
  }
  ZScores scores;
  scores.add("schlick", reflected.estimate(), schlick(std::cos(80 * degrees), 1.5));
  CHECK(std::abs(reflected.estimate().mean - fresnel(std::cos(80 * degrees), 1.5)) > 0.005);
}

}  // namespace tyndall::test::dielectric_test

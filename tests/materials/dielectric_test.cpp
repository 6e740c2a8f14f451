#include "core/materials/dielectric.h"
#include "core/base/math.h"
#include "tests/support/capture.h"
#include "tests/support/event.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

/// Smooth glass, and Fresnel's equations.
namespace tyndall::test::dielectric_test {

namespace {

constexpr double outside_angles[7] = {0, 30, 45, 60, 75, 85, 89}, inside_angles[7] = {0, 20, 30, 35, 40, 41, 60};

/// Reflectances by Fresnel's equations at the angles above, computed apart from this program.
struct Row {
  double index, outside[7], inside[7];
};
constexpr Row rows[] = {{1.1,
                         {0.0022675736961451282, 0.002463439785702649, 0.0038521356816829133, 0.013069966900113736,
                          0.09026091030986885, 0.43393195990767897, 0.8451980411412763},
                         {0.0022675736961451256, 0.002316873111054018, 0.0025936789877172356, 0.002998418860197626,
                          0.0038514670889504454, 0.0041144965398198325, 0.06107929842237152}},
                        {1.333,
                         {0.020373187841971414, 0.02143646586343249, 0.027898364598376118, 0.05969091917515261,
                          0.21237758267672502, 0.5835234786966994, 0.8962764037449136},
                         {0.020373187841971414, 0.02105095423069235, 0.02551916229212317, 0.03347566973632821,
                          0.055581591506910256, 0.06404543682073079, 1.0}},
                        {1.5,
                         {0.04000000000000001, 0.04152262597582155, 0.05023991101223592, 0.08918671280221274,
                          0.2530605629903197, 0.6127996452648274, 0.9041849497801886},
                         {0.040000000000000015, 0.04172851819062226, 0.055190167295375965, 0.0861379914688122,
                          0.24529120428690893, 0.37975126596243775, 1.0}},
                        {2.417,
                         {0.17196883252315948, 0.1734602135951131, 0.18111615664799702, 0.2112614378995903,
                          0.33050000312676975, 0.621708605456824, 0.899745971066883},
                         {0.17196883252315948, 0.19844016424771616, 1.0, 1.0, 1.0, 1.0, 1.0}}};

/// By how much a relative error of the cosine or the index grows in the reflectance.
double condition(double cosine, double eta) {
  const double h = 1e-7, here = fresnel(cosine, eta);
  const auto slope = [&](double c, double e) { return std::abs(fresnel(std::min(c, 1.0), e) - here) / (h * here); };
  return 1 + slope(cosine * (1 - h), eta) + slope(cosine, eta * (1 + h));
}

void check_row(double index, const double (&angles)[7], const double (&expected)[7]) {
  for (int i = 0; i < 7; ++i) {
    const double cosine = std::cos(angles[i] * degrees);
    CAPTURE(index);
    CAPTURE(angles[i]);
    CHECK(fresnel(cosine, index) == doctest::Approx(expected[i]).epsilon(1e-10).scale(0));
    // The cosine and the index are rounded before the formula starts.
    const double tolerance = 2e-6 + 6e-8 * condition(cosine, index);
    const float single = fresnel(static_cast<float>(cosine), static_cast<float>(index));
    CHECK(std::abs(static_cast<double>(single) - expected[i]) < tolerance * expected[i]);
  }
}

}  // namespace

TEST_CASE("fresnel: the exact reflectance of unpolarised light, from both sides") {
  for (const Row& row : rows) {
    check_row(row.index, outside_angles, row.outside);
    check_row(1 / row.index, inside_angles, row.inside);
  }
}

TEST_CASE("fresnel: critical and Brewster's angles") {
  constexpr double angles[][3] = {{1.000001, 89.91897156531019, 45.00002864787543},
                                  {1.1, 65.3800226713429, 47.72631099390627},
                                  {1.333, 48.60662639169027, 53.12322576039242},
                                  {1.5, 41.810314895778596, 56.309932474020215},
                                  {2.417, 24.439743865451863, 67.52335735271564}};
  for (const auto& [index, critical, brewster] : angles) {
    CAPTURE_BOUND(index);
    CHECK(fresnel(std::cos((critical + 1e-5) * degrees), 1 / index) == 1);
    const double below = fresnel(std::cos((critical - 1e-5) * degrees), 1 / index);
    CHECK(below < 1);
    CHECK(below > 0.99 - (index < 1.001 ? 0.2 : 0.0));  // with an index near 1 the reflectance falls steeply there
    // At Brewster's angle one polarisation is not reflected: half of the other's share is left.
    const double c = std::cos(brewster * degrees), s = (index * index - 1) / (index * index + 1);
    CHECK(fresnel(c, index) == doctest::Approx(0.5 * s * s).epsilon(1e-9).scale(0));
  }
}

TEST_CASE("fresnel: continuous at the critical angle, finite and within [0, 1] everywhere") {
  for (const float index : {1.000001f, 1.1f, 1.333f, 1.5f, 2.417f}) {
    const double critical = std::asin(1 / static_cast<double>(index));
    float before = 0;
    for (int i = -4000; i <= 4000; ++i) {  // steps of 1e-9 radians, finer than float resolves
      const float reflectance = fresnel(static_cast<float>(std::cos(critical + 1e-9 * i)), 1 / index);
      REQUIRE(reflectance >= 0.0f);
      REQUIRE(reflectance <= 1.0f);
      if (i > -4000 && index > 1.001f) REQUIRE(reflectance - before < 0.01f);
      before = reflectance;
    }
    CHECK(before == 1.0f);
  }
  for (const float index : {1e-3f, 0.5f, 0.999999f, 1.0f, 1.000001f, 3.0f, 1e3f, 1e6f, 1e15f})
    for (const float cosine : {0.0f, 1e-30f, 1e-20f, 1e-7f, 0.5f, 1.0f}) {
      const float reflectance = fresnel(cosine, index);
      CAPTURE(index);
      CAPTURE(cosine);
      CHECK(reflectance >= 0.0f);
      CHECK(reflectance <= 1.0f);
    }
  CHECK(fresnel(0.5f, 1e6f) > 0.99999f);  // a mirror
}

TEST_CASE("fresnel: nothing is reflected where both sides have the same index") {
  for (const float cosine : {1.0f, 0.7f, 1e-3f, 1e-7f, 1e-20f, 1e-30f, 0.0f}) {
    CHECK(fresnel(cosine, 1.0f) == 0.0f);
    CHECK(refracted_cosine(cosine, 1.0f) == doctest::Approx(cosine));
  }
}

TEST_CASE("schlick: the books' rule: r0 + (1 - r0) (1 - cos)^5, all within glass beyond the critical angle") {
  for (const double index : {1.1, 1.5, 2.5})
    for (const double cosine : {0.0, 0.2, 0.7, 1.0}) {
      const double r0 = std::pow((index - 1) / (index + 1), 2), expected = r0 + (1 - r0) * std::pow(1 - cosine, 5);
      const bool total = 1 - cosine * cosine > 1 / (index * index);
      CHECK(schlick(cosine, index) == doctest::Approx(expected).epsilon(1e-12).scale(0));
      CHECK(schlick(cosine, 1 / index) == doctest::Approx(total ? 1 : expected).epsilon(1e-12).scale(0));
    }
}

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

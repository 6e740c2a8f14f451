#include "core/materials/dielectric.h"
#include "tests/support/capture.h"

#include "core/base/math.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

namespace tyndall::test::fresnel_test {

namespace {

constexpr double degrees = pi / 180;
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

double total_angle_cosine(double index) { return std::sqrt(1 - 1 / (index * index)); }

/// Mean over cosine-weighted directions; `split`: a cosine where the function has a kink.
template <class Function>
double cosine_mean(Function f, double split) {
  // s = sqrt distance from the kink smooths the square root there.
  const auto part = [&](double low, double high, double kink) {
    const double sign = high > kink ? 1 : -1, reach = std::sqrt(std::abs(high - low));
    return tyndall::test::integrate(
        [&](double s) {
          const double mu = kink + sign * s * s;
          return f(mu) * 2 * mu * 2 * s;
        },
        0, reach);
  };
  return (split > 0 ? part(0, split, split) : 0) + part(split, 1, split);
}

}  // namespace

TEST_CASE("fresnel: the exact reflectance of unpolarised light, from both sides") {
  for (const Row& row : rows) {
    check_row(row.index, outside_angles, row.outside);
    check_row(1 / row.index, inside_angles, row.inside);
  }
}

TEST_CASE("fresnel: cosine-weighted means, and their relation by reciprocity") {
  constexpr double means[][3] = {{1.1, 0.025157357352877198, 0.19434492343212997},
                                 {1.333, 0.06640576478307963, 0.4745905708139786},
                                 {1.5, 0.0917779593423513, 0.5963457597077118},
                                 {2.0, 0.1605966370696057, 0.7901491592674015},
                                 {2.417, 0.2121875883242864, 0.8651442347371351}};
  for (const auto& [index, outside, inside] : means) {
    const double n = index;
    const double out = cosine_mean([&](double mu) { return fresnel(mu, n); }, 0);
    const double in = cosine_mean([&](double mu) { return fresnel(mu, 1 / n); }, total_angle_cosine(n));
    CHECK(out == doctest::Approx(outside).epsilon(1e-8).scale(0));
    CHECK(in == doctest::Approx(inside).epsilon(1e-8).scale(0));
    CHECK(1 - in == doctest::Approx((1 - out) / (n * n)).epsilon(1e-8).scale(0));
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

TEST_CASE("schlick: errs as the books' rule does, by these amounts") {
  struct Error {
    double index, outside_max, outside_degrees, outside_mean, inside_max, inside_degrees, inside_mean;
  };
  constexpr Error errors[] = {
      {1.1, 0.21047092392005373, 83.133, 0.02462128426249932, 0.8559101434994882, 65.376, -0.012361462971215},
      {1.3, 0.06830447855471422, 83.547, 0.002690301046013022, 0.9305453649325652, 50.283, -0.025604637184337},
      {1.5, 0.03569263650025467, 84.9735, -0.006063673628065488, 0.9267941546429899, 41.8095, -0.022944222416891},
      {1.8, 0.034522985864240296, 85.4325, -0.008690017931442388, 0.8453483922315829, 33.7455, -0.016173568035475},
      {2.0, 0.04440533499424171, 85.1625, -0.007157483630452592, 0.8150328899090634, 29.997, -0.012369864841287},
      {2.5, 0.08239324118497682, 84.4155, 0.0006795877997086554, 0.7298771270960287, 23.5755, -0.006110811126786}};
  for (const Error& e : errors) {
    CAPTURE(e.index);
    for (const bool inside : {false, true}) {
      const double eta = inside ? 1 / e.index : e.index;
      const auto error = [&](double mu) { return schlick(mu, eta) - fresnel(mu, eta); };
      double maximum = 0, at = 0;
      for (int i = 0; i <= 20000; ++i) {
        const double angle = 90.0 * i / 20000, here = std::abs(error(std::cos(angle * degrees)));
        if (here > maximum) maximum = here, at = angle;
      }
      CHECK(maximum == doctest::Approx(inside ? e.inside_max : e.outside_max).epsilon(1e-9).scale(0));
      CHECK(at == doctest::Approx(inside ? e.inside_degrees : e.outside_degrees).epsilon(1e-9).scale(0));
      const double average = cosine_mean(error, inside ? total_angle_cosine(e.index) : 0);
      CHECK(std::abs(average - (inside ? e.inside_mean : e.outside_mean)) < 1e-8);
    }
  }
}

}  // namespace tyndall::test::fresnel_test

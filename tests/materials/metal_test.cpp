#include "core/materials/metal.h"

#include "core/materials/light.h"
#include "tests/support/event.h"
#include "tests/support/metal_survival.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

namespace tyndall::test::metal_test {

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

/// Fraction of directions about the mirror axis within an angle of cosine c: the density's integral
/// (s+^3 - s-^3) / (4π f^3), s± = c ± sqrt(f^2 - 1 + c^2), over the cap.
double fraction_within(double fuzz, double c) {
  const auto pdf = [&](double mu) {
    const double h = std::sqrt(std::max(fuzz * fuzz - 1 + mu * mu, 0.0)), far = mu + h, near = std::max(mu - h, 0.0);
    return (far * far * far - near * near * near) / (2 * fuzz * fuzz * fuzz);
  };
  const double edge = fuzz < 1 ? std::sqrt(1 - fuzz * fuzz) : 0;  // outside this cone nothing goes
  if (c >= 1) return 0;
  const double low = std::max(c, edge);
  // mu = edge + s^2: the square root at the cone's edge becomes smooth.
  return integrate([&](double s) { return pdf(edge + s * s) * 2 * s; }, std::sqrt(low - edge), std::sqrt(1 - edge),
                   200);
}

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

TEST_CASE("metal: cosine-weighted, a tenth of fuzz squared is lost") {
  for (const double fuzz : {0.0, 0.1, 0.3, 0.5, 1.0}) {
    const double kept = integrate([&](double mu) { return metal_survival(fuzz, mu) * 2 * mu; }, 0, 1);
    CHECK(kept == doctest::Approx(1 - fuzz * fuzz / 10).epsilon(1e-7).scale(0));
  }
}

TEST_CASE("metal: directions about the mirror's are as dense as the ball they end in says") {
  for (const double fuzz : {0.2, 0.7, 1.0}) {
    const Vec3d down = down_at<double>(0.6), mirror{down.x, 0, -down.z};
    std::vector<double> cosines, azimuths;
    const Basis<double> basis = basis_around(mirror);
    for (std::uint32_t i = 0; i < 200000; ++i) {
      const Sampler<double> d = sampler<double>(i);
      const Vec3d out = sample(Metal<double>{fuzz}, event(d, down, up<double>)).direction;
      REQUIRE(length(out) == doctest::Approx(1).epsilon(1e-14).scale(0));
      cosines.push_back(dot(out, mirror));
      azimuths.push_back(std::atan2(dot(out, basis.t), dot(out, basis.s)) / (2 * pi) + 0.5);
    }
    CHECK(kolmogorov_smirnov(azimuths, [](double t) { return t; }) < 2.23);
    // The distribution, tabulated: an integral for each of 200,000 values would take long.
    const double edge = fuzz < 1 ? std::sqrt(1 - fuzz * fuzz) : 0;
    std::vector<double> table;
    for (int i = 0; i <= 4000; ++i) table.push_back(1 - fraction_within(fuzz, edge + (1 - edge) * i / 4000));
    const auto cumulative = [&](double c) {
      const double at = std::clamp((c - edge) / (1 - edge), 0.0, 1.0) * 4000;
      const auto i = static_cast<std::size_t>(std::min(at, 3999.0));
      return table[i] + (at - static_cast<double>(i)) * (table[i + 1] - table[i]);
    };
    CHECK(table.front() == doctest::Approx(0).epsilon(1e-4));
    CHECK(kolmogorov_smirnov(cosines, cumulative) < 2.23);
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

}  // namespace tyndall::test::metal_test

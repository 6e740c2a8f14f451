#include "core/materials/lambertian.h"
#include "core/materials/metal.h"
#include "tests/support/directions.h"
#include "tests/support/event.h"
#include "tests/support/metal_survival.h"

#include <doctest/doctest.h>

/// Scattered directions are drawn with the density that they are said to have; it integrates to the share that leaves.
namespace tyndall::test::pdf_test {

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
  std::vector<double> of_all = fraction;
  CHECK(std::abs(cap.deviate(of_all, drawn)) < 4.5);
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

}  // namespace tyndall::test::pdf_test

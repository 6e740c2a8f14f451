#include "core/base/lanes.h"

#include "core/base/vec.h"
#include "core/targets/kernels.h"
#include "tests/base/lanes_report.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tyndall_targets.h>

using namespace tyndall;  // its functions are called by their full names: the C library has the same ones

namespace {
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
}  // namespace

TEST_CASE("lanes of float: min and max return the second argument if either is not a number") {
  CHECK(tyndall::min(1.0f, 2.0f) == 1.0f);
  CHECK(tyndall::min(2.0f, 1.0f) == 1.0f);
  CHECK(tyndall::max(1.0f, 2.0f) == 2.0f);
  CHECK(tyndall::max(2.0f, 1.0f) == 2.0f);
  CHECK(tyndall::min(not_a_number, 1.0f) == 1.0f);
  CHECK(tyndall::max(not_a_number, 1.0f) == 1.0f);
  CHECK(std::isnan(tyndall::min(1.0f, not_a_number)));
  CHECK(std::isnan(tyndall::max(1.0f, not_a_number)));
  // Of two zeros of different sign the second is answered, too.
  CHECK(std::signbit(tyndall::min(0.0f, -0.0f)));
  CHECK_FALSE(std::signbit(tyndall::min(-0.0f, 0.0f)));
  CHECK(std::signbit(tyndall::max(0.0f, -0.0f)));
}

TEST_CASE("lanes of float: floor gives the largest whole number not above its argument, at every magnitude") {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> exponent(-30, 40), sign(-1, 1);
  for (int i = 0; i < 200000; ++i) {
    const float v = std::copysign(std::exp2(exponent(engine)), sign(engine));
    if (tyndall::floor(v) != std::floor(v)) CHECK_MESSAGE(false, v);
  }
  for (const float v : {0.0f, -0.0f, 1.0f, -1.0f, 0x1p23f, -0x1p23f, 8388607.5f, -8388607.5f, 0.99999994f, -1e-30f})
    CHECK(tyndall::floor(v) == std::floor(v));
  CHECK(tyndall::floor(infinity) == infinity);
  CHECK(tyndall::floor(-infinity) == -infinity);
  CHECK(std::isnan(tyndall::floor(not_a_number)));
}

TEST_CASE("lanes of float: there is one lane, and masks have one bit") {
  CHECK(lanes_of<float> == 1);
  CHECK(bits(true) == 1u);
  CHECK(bits(false) == 0u);
  CHECK(mask_from_bits<float>(3u));
  CHECK_FALSE(mask_from_bits<float>(2u));
  CHECK(mask_and_not(true, false));
  CHECK_FALSE(mask_and_not(true, true));
  CHECK_FALSE(mask_and_not(false, false));
  CHECK(any(true));
  CHECK_FALSE(all(false));
}

TEST_CASE("lanes of float: conversions of numbers and bits, and reading from tables") {
  CHECK(float_bits(1.0f) == 0x3f800000u);
  CHECK(float_from_bits(0xbf800000u) == -1.0f);
  CHECK(to_int(2.9f) == 2);
  CHECK(to_int(-2.9f) == -2);
  CHECK(from_int<float>(-7) == -7.0f);
  CHECK(as_int(0xffffffffu) == -1);
  CHECK(as_uint(-1) == 0xffffffffu);
  CHECK(shift_left<4>(0xf0000001u) == 0x10u);
  CHECK(shift_right<4>(0xf0000001u) == 0x0f000000u);
  CHECK(tyndall::copy_sign(3.0f, -0.0f) == -3.0f);
  const float table[] = {1, 2, 4};
  const std::int32_t whole[] = {5, 6, 7};
  CHECK(gather<float>(table, 2) == 4.0f);
  CHECK(gather<float>(whole, 1) == 6);
  CHECK(load<float>(table + 1) == 2.0f);
  CHECK(mul_add(2.0f, 3.0f, 4.0f) == 10.0f);
  CHECK(neg_mul_add(2.0f, 3.0f, 4.0f) == -2.0f);
}

TEST_CASE("vectors: products, reflection and points along a line") {
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(cross(x, y) == z);
  CHECK(cross(y, z) == x);
  CHECK(cross(z, x) == y);
  CHECK(dot(Vec3d{1, 2, 3}, Vec3d{4, -5, 6}) == 12);
  CHECK(length(Vec3d{2, 3, 6}) == 7);
  CHECK(normalize(Vec3d{0, -4, 0}) == Vec3d{0, -1, 0});
  CHECK(reflect(Vec3d{1, -2, 3}, y) == Vec3d{1, 2, 3});
  CHECK(point_at(Vec3d{1, 1, 1}, 2.0, Vec3d{1, 0, -1}) == Vec3d{3, 1, -1});
  CHECK(max_component(Vec3d{1, 7, 3}) == 7);
  CHECK(select(false, x, y) == y);
}

TEST_CASE("lanes: every wide operation does what it does on float, lane by lane") {
  for (const Target target : available_targets()) {
    if (target == Target::scalar) continue;
    const auto report = use_target<TYNDALL_BUILT_TARGETS>(target, [](auto built) -> test::LanesReport {
      if constexpr (built() == Target::scalar)
        return {};
      else
        return test::lanes_report_for<built()>();
    });
    CAPTURE(std::string(name_of(target)));
    CHECK(report.lanes == floats_in(target) * (floats_in(target) >= 8 ? 2 : 1));
    CHECK(report.lanes == choose_kernels(name_of(target))->lanes);
    CHECK(report.arithmetic == 0);
    CHECK(report.whole_numbers == 0);
    CHECK(report.masks == 0);
    CHECK(report.memory == 0);
    CHECK(report.functions <= 2);  // float and lanes may each err by what the function promises
  }
}

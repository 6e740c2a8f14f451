#include "core/shapes/sphere.h"

#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace tyndall::test::sphere_test {

namespace {

constexpr double epsilon = std::numeric_limits<float>::epsilon();

/// The nearer root by the textbook's quadratic formula, which loses digits to cancellation.
bool naive_hit(Vec3f to_center, float radius, Vec3f d, float& t) {
  const float a = dot(d, d), h = dot(d, to_center), c = dot(to_center, to_center) - radius * radius;
  const float discriminant = h * h - a * c;
  t = (h - std::sqrt(std::max(discriminant, 0.0f))) / a;
  return discriminant > 0;
}

struct Misses {
  int robust = 0, naive = 0;
  double surface = 0;  ///< largest distance of a hit point from the surface
};

/// Shoots rays from the origin at the disc of a sphere at the given distance. Computed in double, all of them hit.
Misses shoot(double distance, double radius, int count) {
  Engine engine(1);
  Misses result;
  for (int i = 0; i < count;) {
    const Vec3f center = rounded(distance * direction(engine));
    const Vec3f d = unit_vector(exact(center) + 0.999 * radius * direction(engine));
    // The exact answer for the numbers that the function is given.
    const Vec3d c = exact(center), u = exact(d);
    const double length2 = dot(u, u), middle = dot(c, u) / length2;
    const Vec3d across = c - middle * u;
    if (!(dot(across, across) < 0.998 * radius * radius)) continue;
    ++i;
    const Interval<float> line = sphere_interval(center, static_cast<float>(radius), d);
    float t;
    result.naive += naive_hit(center, static_cast<float>(radius), d, t) ? 0 : 1;
    result.robust += line.hit ? 0 : 1;
    for (const float root : {line.near, line.far}) {
      const double off = std::abs(length(static_cast<double>(root) * u - c) - radius);
      result.surface = off <= result.surface ? result.surface : off;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("sphere: seen from 10,000 radii away, no ray misses and every hit is on the surface") {
  const Misses far = shoot(1e4, 1, 100000);
  CHECK(far.robust == 0);
  CHECK(far.surface < 64 * epsilon * (1e4 + 1));
  CHECK(far.naive > 10000);  // the textbook's formula misses with more than a tenth of the rays
}

TEST_CASE("sphere: hits are on the surface to rounding at any distance and size") {
  for (const double distance : {0.0, 0.5, 1.001, 2.0, 100.0, 1e4})
    for (const double radius : {1e-3, 1.0, 1e3, 1e6}) {
      const Misses m = shoot(distance * radius, radius, 2000);
      CAPTURE(distance);
      CAPTURE(radius);
      CHECK(m.robust == 0);
      CHECK(m.surface < 64 * epsilon * (distance + 1) * radius);
    }
}

TEST_CASE("sphere: a line that passes it by has no interval, a tangent none or one of no length") {
  for (const float beside : {1.001f, 2.0f, 1e10f})
    CHECK_FALSE(sphere_interval<float>({0, beside, 5}, 1.0f, {0, 0, 1}).hit);
  const Interval<float> tangent = sphere_interval<float>({0, 1, 5}, 1.0f, {0, 0, 1});
  CHECK((!tangent.hit || tangent.far - tangent.near < 1e-3f));
  const Interval<float> behind = sphere_interval<float>({0, 0, -5}, 1.0f, {0, 0, 1});
  CHECK(behind.hit);
  CHECK(behind.near == -6);
  CHECK(behind.far == -4);
  const Interval<float> around = sphere_interval<float>({0, 0, 0.5f}, 2.0f, {0, 0, 1});
  CHECK(around.near == -1.5f);
  CHECK(around.far == 2.5f);
}

TEST_CASE("sphere: what cannot be computed is a miss, and never a distance that is not a number") {
  // The square of this radius is beyond the range of float.
  const Interval<float> huge = sphere_interval<float>({0, -1e30f, 0}, 1e30f, normalize(Vec3f{1, -1, 0}));
  CHECK_FALSE((huge.hit && 0 < huge.near && huge.near < std::numeric_limits<float>::infinity()));
  const Interval<float> none = sphere_interval<float>({NAN, 0, 0}, 1.0f, {0, 0, 1});
  CHECK_FALSE(none.hit);
}

TEST_CASE("sphere: rays that know where they start leave it rightly at every scale, unlike with a least distance") {
  struct Count {
    int self_hits = 0, lost_exits = 0;
  };
  const auto leave = [](double scale) {
    Engine engine(2);
    Count identity, minimum;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const float radius = static_cast<float>(scale);
      const Vec3f center = rounded(3 * scale * direction(engine)), eye = rounded(5 * scale * direction(engine));
      const Vec3f heading = unit_vector(exact(center) + 0.9 * scale * direction(engine) - exact(eye));
      const Interval<float> line = sphere_interval(center - eye, radius, heading);
      if (!line.hit || line.near <= 0) continue;
      const Vec3f p = point_at(eye, line.near, heading), outward = p - center;
      for (const bool out : {true, false}) {
        Vec3f d = unit_vector(direction(engine));
        if ((dot(d, outward) > 0) != out) d = -d;
        const std::int32_t from = 4 * 17 + static_cast<std::int32_t>(out ? Side::outward : Side::inward);
        const Interval<float> plain = sphere_interval(center - p, radius, d);
        const Interval<float> known = leave_sphere(plain, center - p, d, from, start_on<float>(from, 17, 1));
        const float t = known.near > 0 ? known.near : known.far;
        const bool good = known.hit && t > 0 &&
                          std::abs(length(exact(p) + static_cast<double>(t) * exact(d) - exact(center)) - scale) <
                              64 * epsilon * 10 * scale;
        const bool met = plain.hit && (plain.near > 1e-3f || plain.far > 1e-3f);
        (out ? identity.self_hits : identity.lost_exits) += out ? known.hit : !good;
        (out ? minimum.self_hits : minimum.lost_exits) += out ? met : !met;
      }
    }
    CAPTURE(scale);
    CHECK(identity.self_hits == 0);
    CHECK(identity.lost_exits == 0);
    return minimum;
  };
  constexpr int count = 20000;
  CHECK(leave(1e-4).lost_exits > 0.99 * count * 0.5);  // with a least distance rays would never leave the glass
  CHECK(leave(1).self_hits == 0);
  CHECK(leave(1e2).self_hits + leave(1e2).lost_exits > 0);
  CHECK(leave(1e4).self_hits > 0.1 * count);  // with a least distance surfaces would shade themselves
  leave(1e-3), leave(1e-2), leave(1e3), leave(1e5);
  CHECK(leave(1e6).self_hits > 0.1 * count);
}

TEST_CASE("sphere: the way through it keeps its digits where a ray on its inside only grazes it") {
  Engine engine(3);
  double worst_known = 0, worst_plain = 0;  // relative errors of the distance to the far side
  for (int i = 0; i < 1000; ++i) {
    const Vec3d outward = direction(engine), other = direction(engine);
    const Vec3d across = other - dot(other, outward) * outward;
    const Vec3f p = rounded(outward), d = unit_vector((1 / length(across)) * across - 1e-3 * outward);
    const double chord = -2 * dot(exact(d), exact(p)) / length(exact(p));
    const std::int32_t from = 4 * 17 + static_cast<std::int32_t>(Side::inward);
    const Interval<float> plain = sphere_interval(-p, 1.0f, d);
    const Interval<float> known = leave_sphere(plain, -p, d, from, start_on<float>(from, 17, 1));
    worst_known = std::max(worst_known, std::abs(known.far / chord - 1));
    worst_plain = std::max(worst_plain, std::abs(plain.far / chord - 1));
  }
  CHECK(worst_known < 2e-4);
  CHECK(worst_plain > 1e-2);  // what it would be without knowing that the start lies on the sphere
}

TEST_CASE("sphere: a start within it meets the far side alone; a start elsewhere is as usual") {
  const Vec3f to_center{0, 0.3f, 0.2f};
  const Interval<float> line = sphere_interval<float>(to_center, 1.0f, {0, 0, 1});
  const std::int32_t within = 4 * 5 + static_cast<std::int32_t>(Side::within);
  const Interval<float> left = leave_sphere(line, to_center, {0, 0, 1}, within, start_on<float>(within, 5, 1));
  CHECK(left.hit);
  CHECK(left.near < 0);
  CHECK(left.far == line.far);
  const Interval<float> other = leave_sphere(line, to_center, {0, 0, 1}, within, start_on<float>(within, 6, 1));
  CHECK(other.near == line.near);
  CHECK(other.far == line.far);
}

TEST_CASE("start_on: tells which shape a ray starts on, and which way it leaves") {
  for (const std::int32_t element : {0, 1, 7, 1000000})
    for (const Side side : {Side::outward, Side::inward, Side::within}) {
      const std::int32_t from = 4 * element + static_cast<std::int32_t>(side);
      CHECK(start_on<float>(from, element, 1).here);
      CHECK(start_on<float>(from, element, 1).out == (side == Side::outward));
      CHECK_FALSE(start_on<float>(from, element + 1, 6).here);
      CHECK_FALSE(start_on<float>(from, element - 6, 6).here);
      CHECK(start_on<float>(from, element - 5, 6).here);
      CHECK(start_on<float>(from, element, 6).here);
    }
  CHECK_FALSE(start_on<float>(from_nowhere, 0, 6).here);
  CHECK_FALSE(start_on<float>(from_nowhere, 0, 6).out);
}

}  // namespace tyndall::test::sphere_test

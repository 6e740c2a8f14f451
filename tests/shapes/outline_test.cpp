#include "core/shapes/outline.h"

#include "core/compile/columns.h"
#include "core/compile/flatten.h"
#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace tyndall::test::outline_test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Outline in_scene(const Triangle<>& triangle) { return outline_in_scene(triangle, {}, {}); }
Outline in_scene(const Disk<>& disk) { return outline_of(disk); }
Affine map_of(const Triangle<>& triangle) { return triangle_map(triangle, {}, {}); }
Affine map_of(const Disk<>& disk) { return quad_map(frame_of(disk), {}, {}); }

template <class Shape>
QuadHit<float> meet(const Shape& shape, Vec3f origin, Vec3f direction, float limit = infinity) {
  return hit_outlined(map_of(shape), in_scene(shape), origin, direction, limit);
}

}  // namespace

TEST_CASE("triangle: it is the half of its frame with a + b <= 1, seen from in front and behind") {
  const Triangle<> triangle{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
  const auto hit = [&](float x, float y) { return meet(triangle, {x, y, 0}, {0, 0, 1}).hit; };
  CHECK(meet(triangle, {-0.5f, -0.5f, 0}, {0, 0, 1}).t == 2);
  CHECK(meet(triangle, {-0.5f, -0.5f, 7}, {0, 0, -1}).t == 5);
  for (const Vec3f corner : {Vec3f{-1, -1, 0}, Vec3f{1, -1, 0}, Vec3f{-1, 1, 0}}) CHECK(hit(corner.x, corner.y));
  CHECK(hit(0, 0));  // on its longest edge
  CHECK_FALSE(hit(0.001f, 0));
  CHECK_FALSE(hit(-1.001f, 0));
  CHECK_FALSE(hit(0, -1.001f));
  CHECK_FALSE(meet(triangle, {-0.5f, -0.5f, 0}, {0, 0, 1}, 1.9f).hit);  // beyond the limit
  CHECK_FALSE(meet(triangle, {-0.5f, -0.5f, 2}, {0, 0, 1}).hit);        // starts on it
  CHECK_FALSE(meet(triangle, {-2, -0.5f, 2}, {1, 0, 0}).hit);           // in its plane
}

TEST_CASE("disk: its rim is met, its hole is not, and half axes of different lengths make an ellipse") {
  const Disk<> disk{{0, 0, 3}, {1, 0, 0}, {0, 2, 0}, 0}, ring{{0, 0, 3}, {1, 0, 0}, {0, 2, 0}, 0.5};
  const auto hit = [](const Disk<>& d, float x, float y) { return meet(d, {x, y, 0}, {0, 0, 1}).hit; };
  CHECK(hit(disk, 0, 0));
  CHECK(hit(disk, 1, 0));
  CHECK(hit(disk, 0, 2));
  CHECK_FALSE(hit(disk, 1.001f, 0));
  CHECK_FALSE(hit(disk, 0, 2.001f));
  CHECK_FALSE(hit(disk, 0.8f, 1.6f));
  CHECK_FALSE(hit(ring, 0, 0));
  CHECK_FALSE(hit(ring, 0.499f, 0));
  CHECK_FALSE(hit(ring, 0, -0.998f));
  CHECK(hit(ring, 0.501f, 0));
  CHECK(hit(ring, 0, -1.002f));
}

TEST_CASE("outline: points are drawn within it, evenly by area") {
  for (const Outline outline :
       {Outline{Outline::triangle, 0}, Outline{Outline::ring, 0}, Outline{Outline::ring, 0.7f}}) {
    const bool triangle = outline.kind == Outline::triangle;
    constexpr int n = 400, cells = 20;
    std::vector<int> drawn(cells * cells), expected(cells * cells);
    int in_all = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const Pair<float> u{(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(k) + 0.5f) / n};
        const auto cell = [&](Pair<float> at) {
          return static_cast<std::size_t>(std::min(at.x, 0.9999f) * cells) * cells +
                 static_cast<std::size_t>(std::min(at.y, 0.9999f) * cells);
        };
        const Pair<float> at = triangle ? in_triangle(u) : in_ring(outline.size, u);
        const float slack = 1e-6f;
        REQUIRE(at.x >= -slack);
        REQUIRE(at.x <= 1 + slack);
        if (triangle) REQUIRE(at.x + at.y <= 1 + slack);
        ++drawn[cell(at)];
        if (!within(outline, 2 * u.x - 1, 2 * u.y - 1)) continue;
        ++expected[cell(u)], ++in_all;
      }
    CHECK(in_all == doctest::Approx(n * n * area_fraction(outline)).epsilon(0.01));
    for (std::size_t c = 0; c < drawn.size(); ++c) {
      CAPTURE(c);
      CHECK(std::abs(drawn[c] - expected[c] / area_fraction(outline)) <
            0.15 * n * n / (cells * cells) / area_fraction(outline));
    }
  }
}

TEST_CASE("disk: uv are its radius and its angle from the first half axis towards the second") {
  for (const double radius : {0.1, 0.5, 1.0})
    for (const double revolutions : {0.01, 0.25, 0.5, 0.75, 0.99}) {
      const double angle = 2 * pi * revolutions;
      const Pair<float> uv = disk_uv(static_cast<float>(0.5 + 0.5 * radius * std::cos(angle)),
                                     static_cast<float>(0.5 + 0.5 * radius * std::sin(angle)));
      CHECK(static_cast<double>(uv.x) == doctest::Approx(radius).epsilon(1e-5));
      CHECK(static_cast<double>(uv.y) == doctest::Approx(revolutions).epsilon(1e-5));
    }
}

TEST_CASE("outline: bounds hold all of a disk and a triangle, and little more") {
  Engine engine(3);
  for (int i = 0; i < 50; ++i) {
    const Disk<> disk{in_cube(engine, 5), direction(engine), uniform(engine, 0.1, 2) * direction(engine), 0};
    const PlacedShape placed{disk, {uniform(engine, -180, 180), in_cube(engine, 3)}};
    const Extent extent = extent_of(placed, {});
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, direction(engine)}) {
      double points = -1e300, rim = -1e300;
      for (const Vec3d& p : extent.points) points = std::max(points, dot(axis, p - center_of(placed)));
      for (int k = 0; k < 360; ++k) {
        const Vec3d arm = std::cos(k * pi / 180) * disk.u + std::sin(k * pi / 180) * disk.v;
        rim = std::max(rim, dot(axis, rotate(placed.placement, arm)));
      }
      CHECK(points >= rim * (1 - 1e-12));
      CHECK(points <= 1.09 * rim);
    }
  }
}

}  // namespace tyndall::test::outline_test

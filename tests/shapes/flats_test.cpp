#include "core/compile/columns.h"
#include "core/compile/flatten.h"
#include "core/shapes/outline.h"
#include "core/shapes/quad.h"
#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

/// Parallelograms, and what outlines leave of them: triangles, disks, rings.
namespace tyndall::test::flats_test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

QuadHit<float> meet(const Quad<>& quad, Vec3f origin, Vec3f direction, float limit = infinity) {
  return hit_quad(quad_map(quad, {}, {}), origin, direction, limit);
}

}  // namespace

TEST_CASE("quad: rays from in front and behind meet it at the right distance") {
  const Quad<> quad{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
  CHECK(meet(quad, {0, 0, 0}, {0, 0, 1}).hit);
  CHECK(meet(quad, {0, 0, 0}, {0, 0, 1}).t == 2);
  CHECK(meet(quad, {0.5f, -0.5f, 7}, {0, 0, -1}).t == 5);
  CHECK_FALSE(meet(quad, {0, 0, 0}, {0, 0, -1}).hit);       // behind
  CHECK_FALSE(meet(quad, {0, 0, 0}, {0, 0, 1}, 1.9f).hit);  // beyond the limit
  CHECK(meet(quad, {0, 0, 0}, {0, 0, 1}, 2.0f).hit);        // just at the limit: the caller decides about ties
  CHECK_FALSE(meet(quad, {0, 0, 2}, {0, 0, 1}).hit);        // starts on it
}

TEST_CASE("quad: its edges and corners belong to it, and nothing beyond") {
  const Quad<> quad{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
  for (const float x : {-1.0f, 0.0f, 1.0f})
    for (const float y : {-1.0f, 0.0f, 1.0f}) CHECK(meet(quad, {x, y, 0}, {0, 0, 1}).hit);
  const float beyond = std::nextafter(1.0f, 2.0f);
  for (const float side : {-beyond, beyond}) {
    CHECK_FALSE(meet(quad, {side, 0, 0}, {0, 0, 1}).hit);
    CHECK_FALSE(meet(quad, {0, side, 0}, {0, 0, 1}).hit);
  }
}

TEST_CASE("quad: a ray in its plane misses, whatever its direction, and limits nothing") {
  for (const Vec3d corner : {Vec3d{-1, -1, 2}, Vec3d{-1, -1, 0}})
    for (const Vec3f direction : {Vec3f{1, 0, 0}, Vec3f{0, -1, 0}, Vec3f{0.6f, 0.8f, 0}, Vec3f{1, 0, -0.0f}})
      for (const Vec3f origin : {Vec3f{-3, 0, 2}, Vec3f{0, 0, 2}, Vec3f{0, 0, 0}, Vec3f{-3, 0, 1}})
        CHECK_FALSE(meet({corner, {2, 0, 0}, {0, 2, 0}}, origin, direction).hit);
}

TEST_CASE("quad: a parallelogram is hit by the right share of rays, at every size and shape") {
  // Aimed at the bounding rectangle of corner, corner + u, corner + v, corner + u + v in the plane z = 0.
  struct Shape {
    Vec3d u, v;
  };
  const Shape shapes[] = {
      {{1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0.9, 0.2, 0}}, {{1, 0.5, 0}, {-0.7, 1, 0}}, {{1, 0, 0}, {0, 1e-3, 0}}};
  for (const Shape& shape : shapes)
    for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      Engine engine(4);
      const Vec3d u = size * shape.u, v = size * shape.v;
      const Affine map = quad_map({{0, 0, 0}, u, v}, {}, {});
      const double area = std::abs(u.x * v.y - u.y * v.x);
      const double wide = std::abs(u.x) + std::abs(v.x), high = std::abs(u.y) + std::abs(v.y);
      constexpr int count = 40000;
      int met = 0, wrong = 0;
      for (int i = 0; i < count; ++i) {
        const Vec3d target{std::min(u.x, 0.0) + std::min(v.x, 0.0) + wide * uniform(engine, 0, 1),
                           std::min(u.y, 0.0) + std::min(v.y, 0.0) + high * uniform(engine, 0, 1), 0};
        const Vec3d from{target.x + size * uniform(engine, -1, 1), target.y + size * uniform(engine, -1, 1), size};
        const QuadHit<float> hit = hit_quad(map, rounded(from), unit_vector(target - from), infinity);
        met += hit.hit;
        const double a = (target.x * v.y - target.y * v.x) / (u.x * v.y - u.y * v.x);
        const double b = (u.x * target.y - u.y * target.x) / (u.x * v.y - u.y * v.x);
        const double inside = std::min({a, 1 - a, b, 1 - b});
        if (std::abs(inside) > 1e-3) wrong += hit.hit == (inside > 0) ? 0 : 1;  // closer to an edge rounding decides
      }
      CAPTURE(size);
      const double fraction = area / (wide * high);
      CHECK(std::abs(met - fraction * count) <= 4 * std::sqrt(fraction * (1 - fraction) * count));
      CHECK(wrong == 0);
    }
}

TEST_CASE("quad: a direction of any length meets it as the unit one does, and no length decides between hit and miss") {
  // The usual test, whether |d·n| is below 1e-8, would miss with every short direction.
  for (const double size : {1e-6, 1.0, 1e6}) {
    Engine engine(5);
    const Affine map = quad_map({{0, 0, 0}, size * Vec3d{1, 0.2, 0}, size * Vec3d{-0.3, 1, 0.1}}, {}, {});
    int met = 0, wrong = 0, naive = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3d from = size * (in_cube(engine, 2) + Vec3d{0, 0, 3});
      const Vec3f origin = rounded(from), d = unit_vector(size * in_cube(engine, 1) - from);
      const QuadHit<float> hit = hit_quad(map, origin, d, infinity);
      met += hit.hit ? 1 : 0;
      for (const int exponent : {-30, -10, -3, 3, 10, 30}) {  // 1e-9 to 1e9
        const float scale = std::ldexp(1.0f, exponent);
        const QuadHit<float> again = hit_quad(map, origin, scale * d, infinity);
        wrong += again.hit == hit.hit && (!hit.hit || again.t * scale == hit.t) ? 0 : 1;
        naive += hit.hit && std::abs(scale * d.z) < 1e-8f ? 1 : 0;
      }
    }
    CAPTURE(size);
    CHECK(met > 500);
    CHECK(wrong == 0);
    CHECK(naive > met / 2);
  }
}

TEST_CASE("quad: a grazing ray meets it where it should, down to a ten-thousandth of a radian") {
  const Quad<> floor{{-1, 0, -1}, {2, 0, 0}, {0, 0, 2}};
  for (const double slope : {0.1, 1e-2, 1e-3, 1e-4}) {
    const Vec3d from{-3, 3 * slope, 0.2};
    const QuadHit<float> hit = meet(floor, rounded(from), unit_vector({1, -slope, 0}));
    CHECK(hit.hit);
    CHECK(static_cast<double>(hit.t) == doctest::Approx(3 * std::sqrt(1 + slope * slope)).epsilon(1e-5).scale(0));
  }
}

namespace {

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

}  // namespace tyndall::test::flats_test

#include "core/trace/intersect.h"

#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test::slab_test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

BvhNode node_of(Vec3f low, Vec3f high) {
  BvhNode node{};
  node.low[0][0] = low.x, node.low[1][0] = low.y, node.low[2][0] = low.z;
  node.high[0][0] = high.x, node.high[1][0] = high.y, node.high[2][0] = high.z;
  node.count = 1;
  return node;
}

float enter(const BvhNode& node, Vec3f origin, Vec3f direction, float limit = infinity) {
  const Ray<float> ray{origin, direction, 0, from_nowhere};
  const Entry<float> entry = enter_boxes([&](int axis) { return node.low[axis][0]; },
                                         [&](int axis) { return node.high[axis][0]; }, slopes_of(ray), limit);
  return entry.meets ? entry.near : infinity;
}

/// The textbook's test. It rejects boxes without thickness, because a ray enters and leaves them at the same distance.
bool textbook(Vec3f low, Vec3f high, Vec3f o, Vec3f d) {
  const float x0 = (low.x - o.x) / d.x, x1 = (high.x - o.x) / d.x, y0 = (low.y - o.y) / d.y, y1 = (high.y - o.y) / d.y;
  const float z0 = (low.z - o.z) / d.z, z1 = (high.z - o.z) / d.z;
  const float near = std::max({std::min(x0, x1), std::min(y0, y1), std::min(z0, z1)});
  const float far = std::min({std::max(x0, x1), std::max(y0, y1), std::max(z0, z1)});
  return near < far;
}

}  // namespace

TEST_CASE("slabs: rays through the inside of a box enter it where they should; those apart from it do not") {
  const BvhNode node = node_of({-1, -1, -1}, {1, 1, 1});
  int entered = 0, apart = 0, wrong = 0;
  for (int i = 0; i < 125 * 64; ++i) {
    const float at[5] = {-3, -1, 0, 1, 3}, direction[4] = {-1, -0.0f, 0, 1};
    const float o[3] = {at[i % 5], at[i / 5 % 5], at[i / 25 % 5]};
    const float d[3] = {direction[i / 125 % 4], direction[i / 500 % 4], direction[i / 2000 % 4]};
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) continue;
    double near = -1e9, far = 1e9;
    bool touches = true, inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) {
        touches &= std::abs(o[axis]) <= 1, inside &= std::abs(o[axis]) < 1;
        continue;
      }
      near = std::max(near, std::min((-1.0 - o[axis]) / d[axis], (1.0 - o[axis]) / d[axis]));
      far = std::min(far, std::max((-1.0 - o[axis]) / d[axis], (1.0 - o[axis]) / d[axis]));
    }
    const float answer = enter(node, {o[0], o[1], o[2]}, {d[0], d[1], d[2]});
    if (inside && near < far && far > 0) {
      ++entered;
      wrong += static_cast<double>(answer) == std::max(near, 0.0) ? 0 : 1;
    } else if (!touches || near > far || far < 0) {
      ++apart;
      wrong += answer == infinity ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
  CHECK(entered > 200);
  CHECK(apart > 3000);
}

TEST_CASE("slabs: no ray misses a flat box that it goes through") {
  Engine engine(1);
  int lost = 0, lost_in_tree = 0, textbook_lost = 0;
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i) {
    Vec3f low = rounded(in_cube(engine, 1000));
    Vec3f high = low + rounded(in_cube(engine, 10) + Vec3d{10, 10, 10});
    (i % 3 == 0 ? high.x : i % 3 == 1 ? high.y : high.z) = i % 3 == 0 ? low.x : i % 3 == 1 ? low.y : low.z;
    const auto between = [&](float a, float b) { return a + (b - a) * uniform(engine, 0.01, 0.99); };
    const Vec3d through{between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    const Vec3d from = in_cube(engine, 1000);
    const Vec3f o = rounded(from), d = unit_vector(through - from);
    const float near = enter(node_of(low, high), o, d);
    const double distance = length(through - from);
    lost += std::abs(static_cast<double>(near) - distance) < 1e-3 * distance ? 0 : 1;
    const Vec3f slack{1e-3f, 1e-3f, 1e-3f};  // as compile() widens boxes with coordinates of 1000
    lost_in_tree += enter(node_of(low - slack, high + slack), o, d) < infinity ? 0 : 1;
    textbook_lost += textbook(low, high, o, d) ? 0 : 1;
  }
  CHECK(lost < 1e-4 * count);  // rays that graze the box's plane
  CHECK(lost_in_tree == 0);
  CHECK(textbook_lost > 0.99 * count);
}

TEST_CASE("slabs: a box within another is never entered before it, nor left after it") {
  Engine engine(2);
  int wrong = 0;
  for (int i = 0; i < 300000; ++i) {
    const Vec3f a = rounded(in_cube(engine, 100)), size = rounded(in_cube(engine, 10) + Vec3d{10, 10, 10});
    // Often the two boxes share a side, and sometimes all sides.
    const auto part = [&](float low, float extent) { return engine() % 2 ? low : low + extent * 0.3f; };
    const Vec3f b{part(a.x, size.x), part(a.y, size.y), part(a.z, size.z)};
    const auto end = [&](float high, float low) { return engine() % 2 ? high : low + (high - low) * 0.7f; };
    const Vec3f outer_high = a + size;
    const Vec3f inner_high{end(outer_high.x, b.x), end(outer_high.y, b.y), end(outer_high.z, b.z)};
    const Vec3f o = i % 4 ? rounded(in_cube(engine, 150)) : b;
    const Vec3f d =
        i % 5 ? unit_vector(exact(b) - exact(o) + in_cube(engine, 10)) : Vec3f{0, i % 2 ? 1.0f : -1.0f, -0.0f};
    const float limit = i % 3 ? infinity : static_cast<float>(uniform(engine, 1, 200));
    const float outer = enter(node_of(a, outer_high), o, d, limit), inner = enter(node_of(b, inner_high), o, d, limit);
    wrong += outer <= inner ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("slabs: a box beyond the limit, or behind, is not entered; one around the origin is at 0") {
  const BvhNode node = node_of({-1, -1, 4}, {1, 1, 6});
  CHECK(enter(node, {0, 0, 0}, {0, 0, 1}) == 4);
  CHECK(enter(node, {0, 0, 0}, {0, 0, 1}, 4.5f) == 4);
  CHECK(enter(node, {0, 0, 0}, {0, 0, 1}, 4.0f) == 4);  // just at the limit: its element may win the tie
  CHECK(enter(node, {0, 0, 0}, {0, 0, 1}, 3.9f) == infinity);
  CHECK(enter(node, {0, 0, 0}, {0, 0, 1}, -1.0f) == infinity);  // a lane that is not in use
  CHECK(enter(node, {0, 0, 0}, {0, 0, -1}) == infinity);
  CHECK(enter(node, {0, 0, 5}, {0, 0, 1}) == 0);
}

}  // namespace tyndall::test::slab_test

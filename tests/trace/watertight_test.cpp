#include "core/compile/flatten.h"
#include "core/trace/intersect.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// Closed surfaces of triangles: no ray at their edges and corners slips between two of them.

namespace tyndall::test::watertight_test {

namespace {

/// A cube of half width 1 whose faces are n x n cells of two triangles each, or that cube blown up to a sphere. A ray
/// that passes the middle at less than `inner` goes through it. Normals point outward.
struct ClosedMesh {
  std::vector<std::array<Vec3d, 3>> triangles;
  double inner = 1;

  ClosedMesh(int n, bool is_round) {
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          const auto at = [&](int a, int b) {
            const double x = 2.0 * a / n - 1, y = 2.0 * b / n - 1, z = face < 3 ? 1 : -1;
            const Vec3d p = face % 3 == 0 ? Vec3d{x, y, z} : face % 3 == 1 ? Vec3d{z, x, y} : Vec3d{y, z, x};
            return is_round ? normalize(p) : p;
          };
          add({at(i, k), at(i + 1, k), at(i + 1, k + 1)}, face < 3);
          add({at(i, k), at(i + 1, k + 1), at(i, k + 1)}, face < 3);
        }
    for (const auto& t : triangles) inner = std::min(inner, dot(normalize(cross(t[1] - t[0], t[2] - t[0])), t[0]));
  }

  /// The objects of the mesh `scale` times as large, in two groups of the same transform.
  std::vector<Object> objects(double scale, const Transform& transform) const {
    std::vector<Object> halves{{"", Group{}, transform}, {"", Group{}, transform}};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Vec3d a = scale * triangles[i][0], b = scale * triangles[i][1], c = scale * triangles[i][2];
      std::get<Group>(halves[i / 2 % 2].kind).objects.push_back({"", Solid3d{Triangle<>{a, b - a, c - a}, 0}, {}});
    }
    return halves;
  }

 private:
  void add(std::array<Vec3d, 3> corners, bool outward) {
    if (!outward) std::swap(corners[1], corners[2]);
    triangles.push_back(corners);
  }
};

/// Aims rays at points on edges and at corners of a mesh, of which the half starts within it, and returns how many of
/// them do not meet it, or meet it from within although they come from outside.
int slip_through(const ClosedMesh& mesh, double scale, const Transform& transform, const Kernels& kernels, int count,
                 bool from_within) {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = mesh.objects(scale, transform);
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const Placement placement = placement_of(transform);
  const auto in_scene = [&](Vec3d p) { return rounded(place(placement, scale * p) - compiled.origin); };
  Engine engine(1);
  const auto aimed = [&]() -> std::pair<Vec3d, Vec3d> {
    for (;;) {
      const auto& corners = mesh.triangles[engine() % mesh.triangles.size()];
      const std::size_t first = engine() % 3, kind = engine() % 4;
      const double share = kind == 0 ? 0 : kind == 1 ? std::pow(10, uniform(engine, -8, -1)) : uniform(engine, 0, 1);
      const Vec3d to = corners[first] + share * (corners[(first + 1) % 3] - corners[first]);
      const double distance = from_within ? uniform(engine, 0, 0.98) * mesh.inner : uniform(engine, 1.8, 6);
      const Vec3d from = distance * direction(engine);
      const bool through = length(cross(normalize(to - from), from)) < 0.999 * mesh.inner;
      if (from_within || (through && dot(to, to - from) < 0)) return {from, to};
    }
  };
  int leaks = 0;
  std::vector<TraceRay> rays(static_cast<std::size_t>(std::min(count, 1 << 16)));
  std::vector<TraceHit> hits(rays.size());
  for (int done = 0; done < count; done += static_cast<int>(rays.size())) {
    for (TraceRay& ray : rays) {
      const auto [from, to] = aimed();
      ray = {in_scene(from), {}, 0, from_nowhere};
      ray.direction = unit_vector(place(placement, scale * to) - compiled.origin - exact(ray.origin));
    }
    kernels.trace(view.view(), rays.data(), hits.data(), static_cast<int>(rays.size()), false);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto faces = [&] {
        return dot(compiled.elements.center_or_normal[hits[i].element], rays[i].direction) < 0;
      };
      leaks += hits[i].element < 0 || (!from_within && !faces()) ? 1 : 0;
    }
  }
  return leaks;
}

}  // namespace

TEST_CASE("triangles: no ray slips between two that share corners, from either side, at any scale, through groups") {
  const Transform turned{RotateY{33}, Translate{{3, -2, 1}}};
  constexpr int cells[] = {6, 3, 40};
  const int rays = thorough() ? 10'000'000 / 6 : 1 << 16;  // 10^7 from each side at each scale
  for (const Kernels& kernels : available_kernels())
    for (const bool is_round : {false, true})
      for (const int n : tried(cells, 1))
        for (const double scale : {1e-3, 1.0, 1e5})
          for (const bool from_within : {false, true}) {
            CAPTURE(std::string(kernels.isa));
            CAPTURE(is_round);
            CAPTURE(n);
            CAPTURE(scale);
            CAPTURE(from_within);
            const Transform transform = scale == 1 ? turned : Transform{};
            CHECK(slip_through({n, is_round}, scale, transform, kernels, rays, from_within) == 0);
          }
}

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

}  // namespace tyndall::test::watertight_test

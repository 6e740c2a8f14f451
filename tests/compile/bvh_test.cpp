#include "core/compile/bvh.h"

#include "tests/support/mixed_scene.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tyndall::test::bvh_test {

namespace {

BvhInput ball(Vec3f center, float radius, PrimitiveKind kind = PrimitiveKind::sphere) {
  const Vec3f reach{radius, radius, radius};
  return {{center - reach, center + reach}, kind};
}

bool within(const Bounds& inner, const Bounds& outer) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         inner.high.x <= outer.high.x && inner.high.y <= outer.high.y && inner.high.z <= outer.high.z;
}

Bounds child_bounds(const BvhNode& node, int c) {
  return {{node.low[0][c], node.low[1][c], node.low[2][c]}, {node.high[0][c], node.high[1][c], node.high[2][c]}};
}

/// Walks a tree and counts every breach of what core/compile/bvh.h promises.
struct Walk {
  const Bvh& bvh;
  std::vector<std::vector<std::int32_t>> slots;  ///< inputs of each kind, in the order of their slots
  std::vector<int> seen;                         ///< how often each input was in a leaf
  int wrong = 0, depth = 0, open = 0, nodes = 0;

  explicit Walk(const Bvh& tree) : bvh(tree), slots(4), seen(tree.input.size()) {
    for (const std::int32_t i : bvh.order)
      slots[static_cast<std::size_t>(bvh.input[static_cast<std::size_t>(i)].kind)].push_back(i);
    struct Task {
      std::int32_t node;
      int depth, open;
      Bounds bounds;
    };
    constexpr float maximum = std::numeric_limits<float>::max();
    std::vector<Task> tasks{{0, 1, 0, {{-maximum, -maximum, -maximum}, {maximum, maximum, maximum}}}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const BvhNode& node = bvh.nodes[static_cast<std::size_t>(task.node)];
      depth = std::max(depth, task.depth);
      open = std::max(open, task.open + node.count);
      ++nodes;
      wrong += node.count >= 1 && node.count <= bvh_width ? 0 : 1;
      for (int c = 0; c < node.count; ++c) {
        const Bounds bounds = child_bounds(node, c);
        wrong += within(bounds, task.bounds) ? 0 : 1;
        if (node.child[c] < 0)
          leaf(bvh.leaves[static_cast<std::size_t>(~node.child[c])], bounds);
        else
          tasks.push_back({node.child[c], task.depth + 1, task.open + node.count - 1, bounds});
      }
      for (int c = node.count; c < bvh_width; ++c) wrong += child_bounds(node, c) == Bounds{} ? 0 : 1;
    }
    wrong += nodes == static_cast<int>(bvh.nodes.size()) ? 0 : 1;
    wrong += depth == bvh.depth ? 0 : 1;
    wrong += bvh.order.size() == bvh.input.size() ? 0 : 1;
    for (const int times : seen) wrong += times == 1 ? 0 : 1;
  }

  void leaf(const BvhLeaf& l, const Bounds& bounds) {
    const auto& own = slots[static_cast<std::size_t>(l.kind)];
    wrong += l.count >= 1 && l.first >= 0 && static_cast<std::size_t>(l.first + l.count) <= own.size() ? 0 : 1;
    for (int k = l.first; k < l.first + l.count; ++k) {
      const auto i = static_cast<std::size_t>(own[static_cast<std::size_t>(k)]);
      ++seen[i];
      wrong += within(bvh.input[i].bounds, bounds) && bvh.input[i].kind == l.kind ? 0 : 1;
    }
  }
};

Bvh checked(std::vector<BvhInput> input) {
  const std::vector<BvhInput> given = input;
  Bvh bvh = build_bvh(std::move(input));
  const Walk walk(bvh);
  CHECK(walk.wrong == 0);
  CHECK(walk.open <= bvh_stack);
  CHECK(bvh.input == given);
  return bvh;
}

PrimitiveKind some_kind(Engine& engine) { return static_cast<PrimitiveKind>(engine() % 4); }

bool same_tree(const Bvh& a, const Bvh& b) {
  if (a.order != b.order || a.nodes.size() != b.nodes.size() || a.leaves.size() != b.leaves.size()) return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    for (int c = 0; c < bvh_width; ++c)
      if (a.nodes[i].child[c] != b.nodes[i].child[c] || !(child_bounds(a.nodes[i], c) == child_bounds(b.nodes[i], c)))
        return false;
  return true;
}

}  // namespace

TEST_CASE("bvh: every primitive is in one leaf of its kind, every box within its parent's") {
  Engine engine(1);
  for (const int count : {1, 2, 3, 5, 17, 100, 3000, 30000}) {
    std::vector<BvhInput> input;
    for (int i = 0; i < count; ++i)
      input.push_back(ball(rounded(in_cube(engine, 10)), static_cast<float>(uniform(engine, 0, 2)), some_kind(engine)));
    const Bvh bvh = checked(input);
    CHECK(bvh.depth <= 2 + static_cast<int>(std::log2(count)));
    CHECK(same_tree(bvh, build_bvh(input)));
  }
}

TEST_CASE("bvh: primitives in one place, alike or of all kinds, make a balanced tree") {
  Engine engine(2);
  for (const int count : {2, 5, 1000, 100000}) {
    const Bvh alike = checked(std::vector<BvhInput>(static_cast<std::size_t>(count), ball({1, 2, 3}, 0.5f)));
    CHECK(alike.depth <= 2 + static_cast<int>(std::log2(count)));
    std::vector<BvhInput> kinds, concentric;
    for (int i = 0; i < count; ++i) {
      kinds.push_back(ball({1, 2, 3}, 0.5f, some_kind(engine)));
      concentric.push_back(ball({0, 0, 0}, 1 + 0.001f * static_cast<float>(i % 1000)));
    }
    CHECK(checked(kinds).depth <= 5 + static_cast<int>(std::log2(count)));
    CHECK(checked(concentric).depth <= 2 + static_cast<int>(std::log2(count)));
  }
}

TEST_CASE("bvh: centres that shrink by powers cannot exhaust a traversal's stack") {
  for (const float factor : {0.9f, 0.5f, 0.25f, 0.06f}) {
    std::vector<BvhInput> line, corner;
    for (float x = 1e30f; x > 1e-30f; x *= factor)
      for (int copy = 0; copy < 20; ++copy) {
        line.push_back(ball({x, 0, 0}, 0));
        corner.push_back(
            ball({x, copy % 2 ? x : -x, copy % 3 ? x : 0}, x * 1e-3f, static_cast<PrimitiveKind>(copy % 4)));
      }
    const Bvh deep = checked(line);
    checked(corner);
    if (factor < 0.07f) CHECK(deep.depth < 48 + 24 + 3);
  }
}

TEST_CASE("bvh: a huge sphere does not spoil the tree of the others") {
  Engine engine(3);
  std::vector<BvhInput> input;
  for (int i = 0; i < 4000; ++i) input.push_back(ball(rounded(in_cube(engine, 10)), 0.05f));
  for (const float radius : {1e3f, 1e10f, 1e19f, 1e30f, 1e38f}) {
    std::vector<BvhInput> with = input;
    with.insert(with.begin() + 1234, ball({0, -radius, 0}, radius));
    const Bvh bvh = checked(with);
    CHECK(bvh.depth <= 2 + static_cast<int>(std::log2(input.size())));
  }
}

TEST_CASE("bvh: primitives whose boxes are flat, or a single point, are found") {
  Engine engine(4);
  std::vector<BvhInput> flat, points, one_plane;
  for (int i = 0; i < 2000; ++i) {
    Vec3f low = rounded(in_cube(engine, 10)), high = low + Vec3f{1, 1, 1};
    (i % 3 == 0 ? high.x : i % 3 == 1 ? high.y : high.z) = i % 3 == 0 ? low.x : i % 3 == 1 ? low.y : low.z;
    flat.push_back({{low, high}, PrimitiveKind::quad});
    points.push_back({{low, low}, some_kind(engine)});
    low.y = 0;
    one_plane.push_back({{low, {low.x + 1, 0, low.z + 1}}, PrimitiveKind::quad});
  }
  for (const auto& input : {flat, points, one_plane}) CHECK(checked(input).depth <= 13);
}

TEST_CASE("bvh: of twenty thousand equal spheres the first one is met, on every instruction set") {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  for (int i = 0; i < 20000; ++i)  // not exact copies, which would be left out, but equal in single precision
    scene.objects.push_back({"", Solid3d{Sphere<>{{0, 0, 0}, 1 + 1e-14 * i, {}}, 0}, {}});
  const RenderScene compiled = compile(scene);
  Engine engine(5);
  std::vector<TraceRay> rays;
  for (int i = 0; i < (thorough() ? 32 : 8); ++i) {
    const Vec3d from = 5.0 * direction(engine);
    rays.push_back({rounded(from), unit_vector(0.5 * direction(engine) - from), 0, from_nowhere});
  }
  for (const Kernels& kernels : available_kernels())
    for (const TraceHit& hit : traced(kernels, compiled, rays)) CHECK(hit.element == 0);
}

TEST_CASE("bvh: a thousand spheres around one centre, and spheres from 1e-6 to 1e6, are met as without the tree") {
  for (const bool concentric : {true, false}) {
    Engine engine(6);
    Scene scene;
    scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
    for (int i = 0; i < 1000; ++i) {
      const double size = std::pow(10, uniform(engine, -6, 6));
      const Sphere<> sphere{concentric ? Vec3d{} : 3 * size * direction(engine), concentric ? 1 + i * 0.002 : size, {}};
      scene.objects.push_back({"", Solid3d{sphere, 0}, {}});
    }
    const RenderScene compiled = compile(scene);
    std::vector<TraceRay> rays;
    for (int i = 0; i < 6000; ++i) {
      const double size = concentric ? 2 : std::pow(10, uniform(engine, -6, 6));
      const Vec3d from = 2 * size * direction(engine);
      rays.push_back({rounded(from - compiled.origin), unit_vector(size * direction(engine) - from), 0, from_nowhere});
    }
    const std::vector<TraceRay> starts = rays;
    const auto leaving = rays_from_surfaces(engine, compiled, scalar_kernels(), starts);
    rays.insert(rays.end(), leaving.begin(), leaving.end());
    const Kernels kernels = available_kernels().back();
    const auto by_tree = traced(kernels, compiled, rays), by_force = traced(kernels, compiled, rays, true);
    int different = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      different += by_tree[i].element == by_force[i].element ? 0 : 1;
      met += by_tree[i].element >= 0 ? 1 : 0;
    }
    CHECK(different == 0);
    CHECK(met > 5000);
  }
}

TEST_CASE("bvh: a sphere of radius 1e30 hides nothing") {
  Engine engine(7);
  Scene scene = mixed_scene(engine, {.count = 60, .middle = {}});
  const RenderScene without = compile(scene);
  scene.objects.push_back({"", Solid3d{Sphere<>{{0, -2e30, 0}, 1e30, {}}, 0}, {}});
  const RenderScene with = compile(scene);
  const auto rays = random_rays(engine, 20000, 8);
  std::vector<TraceRay> moved = rays;  // the new sphere has moved the compiled scene's origin
  for (TraceRay& ray : moved) ray.origin = rounded(exact(ray.origin) + without.origin - with.origin);
  for (const Kernels& kernels : available_kernels()) {
    const auto before = traced(kernels, without, rays), after = traced(kernels, with, moved);
    int lost = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (before[i].element < 0) continue;
      ++met;
      lost += after[i].element == before[i].element ? 0 : 1;
    }
    CHECK(met > 1000);
    CHECK(lost <= 1);  // the moved rays are rounded, so one at an edge may miss
  }
}

}  // namespace tyndall::test::bvh_test

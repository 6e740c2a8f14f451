#include "tests/support/mixed_scene.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace tyndall::test::trace_test {

namespace {

const Mixture mixtures[] = {
    {},
    {.count = 600, .half_width = 2, .middle = {}},
    {.count = 200, .middle = {}, .smallest = 1e-5, .largest = 3},
    {.count = 60, .middle = {1e5, -2e5, 3e5}},
    {.count = 700, .half_width = 3, .middle = {}, .kinds = 7},
};

/// Random rays, rays along the axes, and rays that leave surfaces.
std::vector<TraceRay> all_kinds_of_rays(Engine& engine, const RenderScene& scene, double half_width, int each) {
  std::vector<TraceRay> rays = random_rays(engine, each, half_width);
  const std::vector<TraceRay> parallel = parallel_rays(engine, each, half_width, scene);
  const auto leaving = rays_from_surfaces(engine, scene, scalar_kernels(), random_rays(engine, each, half_width));
  rays.insert(rays.end(), parallel.begin(), parallel.end());
  rays.insert(rays.end(), leaving.begin(), leaving.end());
  return rays;
}

bool same(const TraceHit& a, const TraceHit& b) {
  return a.element == b.element && (a.element < 0 || (a.t == b.t && std::isfinite(a.t) && a.t > 0));
}

int differences(const std::vector<TraceHit>& a, const std::vector<TraceHit>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += same(a[i], b[i]) ? 0 : 1;
  return count;
}

double fraction_of_hits(const std::vector<TraceHit>& hits) {
  const auto met = std::count_if(hits.begin(), hits.end(), [](const TraceHit& h) { return h.element >= 0; });
  return static_cast<double>(met) / static_cast<double>(hits.size());
}

}  // namespace

TEST_CASE("trace: the tree finds what testing every primitive finds, to the last bit") {
  std::size_t total = 0;
  const Kernels widest = available_kernels().back();
  for (const Mixture& mix : mixtures) {
    Engine engine(7);
    const RenderScene scene = compile(mixed_scene(engine, mix));
    REQUIRE_FALSE(scene.bvh.nodes.empty());
    for (const Kernels& kernels : available_kernels()) {
      const int each = kernels.lanes == widest.lanes && thorough() ? 120000 : 8000;
      const auto rays = all_kinds_of_rays(engine, scene, 1.6 * mix.half_width, each);
      const auto by_tree = traced(kernels, scene, rays), by_force = traced(kernels, scene, rays, true);
      CAPTURE(std::string(kernels.isa));
      CHECK(differences(by_tree, by_force) == 0);
      CHECK(fraction_of_hits(by_tree) > 0.05);
      CHECK(fraction_of_hits(by_tree) < 0.95);
      total += rays.size();
    }
  }
  CHECK(total >= (thorough() ? 1000000 : 100000));
}

TEST_CASE("trace: the tree loses nothing on small tilted flats far from the scene's origin") {
  Engine engine(3);
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  constexpr double far = 1e5;  // along y alone; on tilted flats its rounding also shifts the other coordinates
  std::vector<Vec3d> targets;
  for (int i = 0; i < 40; ++i) scene.objects.push_back({"", Solid3d{Sphere<>{in_cube(engine, 1), 0.1, {}}, 0}, {}});
  for (int i = 0; i < 38; ++i) {
    targets.push_back(in_cube(engine, 1) + Vec3d{0, far, 0});
    const double size = 0.01 * std::pow(100, uniform(engine, 0, 1));
    Object quad{"", Solid3d{Quad<>{targets.back(), size * direction(engine), size * direction(engine)}, 0}, {}};
    Object box{"", Solid3d{Box<>{{-size, -size, -size}, {size, size, size}}, 0}, {}};
    box.transform = {RotateY{uniform(engine, 0, 360)}, Translate{targets.back()}};
    scene.objects.push_back(i % 2 ? quad : box);
  }
  const RenderScene compiled = compile(scene);
  REQUIRE(length(compiled.origin) < 10);
  std::vector<TraceRay> rays;
  for (int i = 0; i < 300000; ++i) {
    const Vec3d to = targets[engine() % targets.size()] + in_cube(engine, 0.3);
    const Vec3d from = Vec3d{0, far, 0} + in_cube(engine, i % 3 ? 3 : 30);
    rays.push_back({rounded(from - compiled.origin), unit_vector(to - from), 0, from_nowhere});
  }
  const Kernels kernels = available_kernels().back();
  CHECK(differences(traced(kernels, compiled, rays), traced(kernels, compiled, rays, true)) == 0);
}

/// Rays from far away towards a scene of half width 1; `together` in a row go nearly the same way.
std::vector<TraceRay> distant_rays(Engine& engine, double distance, int count, int together = 1) {
  std::vector<TraceRay> rays;
  Vec3d from, to;
  for (int i = 0; i < count; ++i) {
    if (i % together == 0) {
      // A quarter of them nearly along an axis.
      from = distance * direction(engine);
      if (i / together % 4 == 0) from = {i % 8 ? distance : -distance, uniform(engine, -1, 1), uniform(engine, -1, 1)};
      to = in_cube(engine, 1.2);
    }
    rays.push_back({rounded(from), unit_vector(to + in_cube(engine, 0.02) - from), 0.5f, from_nowhere});
  }
  return rays;
}

TEST_CASE("trace: seen from 1000 scene sizes away the tree loses nothing; from farther, next to nothing") {
  Engine engine(3);
  const RenderScene scene =
      compile(mixed_scene(engine, {.half_width = 1, .middle = {}, .smallest = 1e-3, .largest = 0.3}));
  for (const double distance : {10.0, 1e3, 1e5}) {
    const auto rays = distant_rays(engine, distance, 200000);
    for (const Kernels& kernels : available_kernels()) {
      if (kernels.lanes < available_kernels().back().lanes) continue;
      const auto by_tree = traced(kernels, scene, rays);
      const int differ = differences(by_tree, traced(kernels, scene, rays, true));
      CAPTURE(distance);
      CHECK(differ <= (distance > 1e4 ? 100 : 0));  // from so far the ray itself is rounded by 0.01
      CHECK(fraction_of_hits(by_tree) > 0.3);
    }
  }
}

TEST_CASE("trace: each ray alone and in random company meets the same, to the last bit") {
  for (const Kernels& kernels : available_kernels()) {
    if (kernels.lanes == 1) continue;  // with one lane each ray is always alone
    Engine engine(11);
    const RenderScene scene =
        compile(mixed_scene(engine, {.half_width = 1, .middle = {}, .smallest = 1e-3, .largest = 0.3}));
    const SceneViewOf view(scene);
    auto rays = all_kinds_of_rays(engine, scene, 1.6, 100000);
    // Also rays from so far away that some meet a primitive but, by rounding, miss its box, which their neighbours
    // meet.
    for (const TraceRay& ray : distant_rays(engine, 1e5, 100000, kernels.lanes)) rays.push_back(ray);
    std::vector<TraceHit> alone(rays.size()), in_group(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) kernels.trace(view.view(), &rays[i], &alone[i], 1, false);
    CAPTURE(std::string(kernels.isa));
    CHECK(differences(alone, traced(kernels, scene, rays)) == 0);
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), engine);
    std::vector<TraceRay> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    const std::vector<TraceHit> hits = traced(kernels, scene, shuffled);
    for (std::size_t i = 0; i < order.size(); ++i) in_group[order[i]] = hits[i];
    CHECK(differences(alone, in_group) == 0);
    CHECK(rays.size() > 300000);
  }
}

TEST_CASE("trace: every instruction set meets what the scalar one meets, but for near ties") {
  for (const Mixture& mix : mixtures) {
    Engine engine(5);
    const RenderScene scene = compile(mixed_scene(engine, mix));
    const auto rays = all_kinds_of_rays(engine, scene, 1.6 * mix.half_width, 40000);
    const std::vector<TraceHit> plain = traced(scalar_kernels(), scene, rays);
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<TraceHit> hits = traced(kernels, scene, rays);
      int other_element = 0, other_distance = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].element != plain[i].element) ++other_element;
        if (hits[i].element < 0 || hits[i].element != plain[i].element) continue;
        const double off = std::abs(static_cast<double>(hits[i].t) - static_cast<double>(plain[i].t));
        other_distance += off > 1e-5 * (mix.half_width + static_cast<double>(plain[i].t)) ? 1 : 0;
      }
      CAPTURE(std::string(kernels.isa));
      CHECK(other_element <= 1e-5 * static_cast<double>(rays.size()));
      CHECK(other_distance <= 1e-4 * static_cast<double>(rays.size()));  // rays that graze a sphere
    }
  }
}

TEST_CASE("trace: of equal distances the lower element wins, in the tree and without it") {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  // Equal in single precision, but not exact copies, which would be left out.
  const auto left = [](int i) { return -1 - 1e-12 * i; };
  const auto quad = [&](int i) { return Object{"", Solid3d{Quad<>{{left(i), -1, 0}, {2, 0, 0}, {0, 2, 0}}, 0}, {}}; };
  const auto box = [&](int i) { return Object{"", Solid3d{Box<>{{left(i), -1, -2}, {1, 1, 0}}, 0}, {}}; };
  for (const int count : {2, 40}) {
    for (const bool box_first : {false, true}) {
      scene.objects.clear();
      for (int i = 0; i < count; ++i) scene.objects.push_back((i == 0) == box_first ? box(i) : quad(i));
      const RenderScene compiled = compile(scene);
      CHECK(compiled.bvh.nodes.empty() == (count <= 16));
      const std::vector<TraceRay> rays(40,
                                       {rounded(Vec3d{0.3, -0.2, 5} - compiled.origin), {0, 0, -1}, 0, from_nowhere});
      for (const Kernels& kernels : available_kernels())
        for (const bool by_force : {false, true})
          for (const TraceHit& hit : traced(kernels, compiled, rays, by_force)) {
            CHECK(hit.element == (box_first ? 5 : 0));  // the box's face z+
            CHECK(hit.t == doctest::Approx(5));
          }
    }
  }
}

TEST_CASE("trace: outward a shape is never met again, inward it is always left, at every scale") {
  for (const double scale : {1e-4, 1.0, 1e3, 1e6}) {
    Engine engine(13);
    const Mixture mix{.count = 200, .half_width = 5 * scale, .middle = {}, .smallest = 0.02 * scale, .largest = scale};
    const RenderScene scene = compile(mixed_scene(engine, mix));
    const Elements& all = scene.elements;
    for (const Kernels& kernels : available_kernels()) {
      const auto rays = rays_from_surfaces(engine, scene, kernels, random_rays(engine, 100000, 8 * scale));
      const std::vector<TraceHit> hits = traced(kernels, scene, rays);
      int met_again = 0, lost = 0, closed = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto start = static_cast<std::size_t>(rays[i].from / 4);
        const bool outward = rays[i].from % 4 == static_cast<std::int32_t>(Side::outward);
        const bool quad = std::find(scene.quads.element.begin(), scene.quads.element.end(), rays[i].from / 4) !=
                          scene.quads.element.end();
        const bool itself =
            hits[i].element >= 0 && all.object[static_cast<std::size_t>(hits[i].element)] == all.object[start];
        if (outward || quad) {
          met_again += itself ? 1 : 0;
        } else {
          ++closed;
          lost += hits[i].element < 0 || !(hits[i].t > 0) ? 1 : 0;
        }
      }
      CAPTURE(scale);
      CHECK(met_again == 0);
      CHECK(lost == 0);
      CHECK(closed > 1000);
    }
  }
}

TEST_CASE("trace: works without rays and without primitives") {
  const RenderScene empty = compile(Scene{});
  for (const Kernels& kernels : available_kernels()) {
    CHECK(traced(kernels, empty, {}).empty());
    const std::vector<TraceRay> rays(5, {{0, 0, 0}, {0, 0, -1}, 0, from_nowhere});
    for (const TraceHit& hit : traced(kernels, empty, rays)) CHECK(hit.element == -1);
  }
}

TEST_CASE("kernels: the list starts with scalar, grows in width, and is searched by name") {
  const std::vector<Kernels> list = available_kernels();
  REQUIRE(!list.empty());
  CHECK(std::string(list.front().isa) == "scalar");
  CHECK(list.front().lanes == 1);
  for (std::size_t i = 1; i < list.size(); ++i) CHECK(list[i].lanes > list[i - 1].lanes);
  CHECK(std::string(choose_kernels("")->isa) == list.back().isa);
  for (const Kernels& kernels : list) CHECK(choose_kernels(kernels.isa)->lanes == kernels.lanes);
  CHECK_FALSE(choose_kernels("avx3"));
  CHECK_FALSE(choose_kernels("AVX2"));
}

}  // namespace tyndall::test::trace_test

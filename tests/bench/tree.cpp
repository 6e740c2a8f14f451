#include "tests/bench/bench.h"
#include "tests/bench/measure.h"
#include "tests/bench/rays.h"
#include "tests/bench/scenes.h"
#include "tests/support/prepared.h"

namespace tyndall::bench {

using namespace test;
namespace {

/// Million rays a second of rendering, one thread, path and random.
double render_speed(const RenderScene& scene, std::uint32_t spp, int repeat) {
  std::vector<double> speeds;
  for (int i = 0; i < repeat; ++i) {
    const RenderResult result = render(scene, {.threads = 1, .spp = spp});
    speeds.push_back(static_cast<double>(result.rays) / result.seconds * 1e-6);
  }
  return median(speeds);
}

/// Million closest hits a second, one thread, rays in path order.
double trace_speed(const RenderScene& scene, std::size_t count, int repeat) {
  const Kernels kernels = *choose_kernels("");
  const SceneViewOf view(scene);
  const std::vector<TraceRay> rays = rays_in_path_order(scene, kernels, count);
  std::vector<TraceHit> hits(count);
  std::vector<double> speeds;
  for (int i = 0; i < repeat; ++i) {
    const double seconds =
        seconds_of([&] { kernels.trace(view.view(), rays.data(), hits.data(), static_cast<int>(count), false); });
    speeds.push_back(static_cast<double>(count) / seconds * 1e-6);
  }
  return median(speeds);
}

}  // namespace

Json measure_tree(const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : settings.quick ? 3 : 7;
  Table table("Trees over spheres: compile() on all cores, bytes of the compiled scene, one thread's Mrays/s",
              {{"spheres", "spheres", 0},
               {"build_ms", "build ms", 1},
               {"bytes_per_sphere", "bytes/sphere", 0},
               {"tree_bytes_per_sphere", "of them tree", 0},
               {"depth", "depth", 0},
               {"render_mrays_per_s", "render Mrays/s", 1},
               {"trace_mrays_per_s", "closest Mrays/s", 1}});
  for (const int spheres : {500, 5000, 20000, 100000}) {
    Scene scene = field_of_spheres(spheres);
    scene.render.integrator = Integrator::path;
    scene.render.sampler = SamplerKind::random;
    RenderScene compiled;
    std::vector<double> seconds;
    for (int i = 0; i < repeat; ++i) seconds.push_back(seconds_of([&] { compiled = compile(scene); }));
    RenderScene bare = compiled;
    bare.bvh = {};
    const std::size_t bytes = bytes_of(compiled);
    Json row;
    row["spheres"] = spheres;
    row["build_ms"] = 1000 * median(seconds);
    row["bytes_per_sphere"] = static_cast<double>(bytes) / spheres;
    row["tree_bytes_per_sphere"] = static_cast<double>(bytes - bytes_of(bare)) / spheres;
    row["depth"] = compiled.bvh.nodes.empty() ? Json(nullptr) : Json(compiled.bvh.depth);
    row["render_mrays_per_s"] = render_speed(compiled, settings.quick ? 4 : 16, repeat);
    row["trace_mrays_per_s"] = trace_speed(compiled, settings.quick ? 1u << 17 : 1u << 19, repeat);
    table.add(row);
  }
  return table.rows();
}

}  // namespace tyndall::bench

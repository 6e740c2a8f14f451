#include "tests/bench/bench.h"
#include "tests/bench/measure.h"
#include "tests/bench/scenes.h"
#include "tests/support/prepared.h"

#include <algorithm>

namespace tyndall::bench {

using namespace test;
namespace {

struct Method {
  Integrator integrator;
  SamplerKind sampler;
  const char* integrator_name;
  const char* sampler_name;
};
constexpr Method methods[] = {{Integrator::path, SamplerKind::random, "path", "random"},
                              {Integrator::mis, SamplerKind::sobol, "mis", "sobol"}};

/// One row of the table: what is rendered, and what was measured.
struct Job {
  Method method;
  Kernels kernels;
  RenderScene scene;
  RenderOptions options;
  std::uint64_t rays = 0;
  std::vector<double> seconds;

  void run() {
    const RenderResult result = render(scene, options);
    rays = result.rays;
    seconds.push_back(result.seconds);
  }
  double samples() const { return static_cast<double>(scene.width) * scene.height * *options.spp; }
};

/// A job that takes about `seconds` a run.
Job make_job(Scene scene, Method method, const Kernels& kernels, double seconds) {
  scene.render.integrator = method.integrator;
  scene.render.sampler = method.sampler;
  Job job{method, kernels, compile(scene), RenderOptions{}, 0, {}};
  job.options.threads = 1;
  job.options.isa = kernels.isa;
  job.options.spp = 1;
  job.run();
  job.options.spp = static_cast<std::uint32_t>(std::clamp(seconds / job.seconds.front(), 1.0, 4096.0));
  job.seconds.clear();
  return job;
}

/// Fraction of the lanes that follow a path, on average over the steps that lanes take together.
double lanes_alive(const Job& job) {
  constexpr int edge = 16;
  const SceneViewOf view(job.scene);
  TileCounts counts;
  std::vector<FilmPixel> pixels;
  for (int y = 0; y < job.scene.height; y += edge)
    for (int x = 0; x < job.scene.width; x += edge) {
      const Region tile{x, y, std::min(x + edge, job.scene.width), std::min(y + edge, job.scene.height)};
      pixels.assign(static_cast<std::size_t>(tile.width()) * static_cast<std::size_t>(tile.height()), {});
      job.kernels.render_tile(view.view(), {.tile = tile, .first = 0, .last = 8}, 1, pixels.data(), counts);
    }
  return static_cast<double>(counts.rays - counts.shadow_rays) / static_cast<double>(counts.steps) / job.kernels.lanes;
}

Json row_of(const std::string& name, const Job& job) {
  const double seconds = median(job.seconds), rays = static_cast<double>(job.rays);
  Json row;
  row["scene"] = name;
  row["width"] = job.scene.width, row["height"] = job.scene.height;
  row["integrator"] = job.method.integrator_name, row["sampler"] = job.method.sampler_name;
  row["isa"] = job.kernels.isa, row["lanes"] = job.kernels.lanes;
  row["threads"] = 1;
  row["spp"] = *job.options.spp;
  row["msamples_per_s"] = job.samples() / seconds * 1e-6;
  row["mrays_per_s"] = rays / seconds * 1e-6;
  row["rays_per_sample"] = rays / job.samples();
  row["lanes_alive"] = lanes_alive(job);
  row["seconds"] = job.seconds;
  return row;
}

}  // namespace

Json measure_throughput(const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : settings.quick ? 3 : 7;
  const double seconds = settings.quick ? 0.05 : 0.3;
  Table table("Throughput: one thread, median of " + std::to_string(repeat) + " interleaved runs; shadow rays counted",
              {{"scene", "scene", -1, 17},
               {"integrator", "integrator"},
               {"sampler", "sampler"},
               {"isa", "isa", -1, 6},
               {"lanes", "lanes", 0},
               {"msamples_per_s", "Msamples/s", 2},
               {"mrays_per_s", "Mrays/s", 1},
               {"rays_per_sample", "rays/sample", 2},
               {"lanes_alive", "lanes alive", 2}});
  std::vector<NamedScene> scenes = book_scenes();
  scenes.push_back({"46-spheres", forty_six_spheres()});
  for (const NamedScene& named : scenes) {
    std::vector<Job> jobs;
    for (const Method& method : methods)
      for (const Kernels& kernels : available_kernels())
        jobs.push_back(make_job(named.scene, method, kernels, seconds));
    for (int i = 0; i < repeat; ++i)
      for (Job& job : jobs) job.run();
    for (const Job& job : jobs) table.add(row_of(named.name, job));
  }
  return table.rows();
}

}  // namespace tyndall::bench

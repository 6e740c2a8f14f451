#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "core/system/child.h"
#include "tests/bench/bench.h"
#include "tests/support/references.h"
#include "tests/support/scratch.h"

#include <nlohmann/json.hpp>

#include <numeric>
#include <random>

/// How long a program takes to an accuracy, and, where another is named, how much longer than that one: both are run as
/// users run them.
namespace tyndall::bench {
namespace fs = std::filesystem;
namespace {

Object sphere(Vec3d center, double radius, int material) {
  Object object;
  object.kind = Solid3d{Sphere<>{center, radius, std::nullopt}, material};
  return object;
}

/// A floor and twelve spheres beneath `count` lights as small as fireflies, which the camera does not see; they give
/// about as much light for any count.
Scene floor_beneath_lights(int count) {
  Scene scene;
  scene.width = 160, scene.height = 90;
  scene.camera = {.look_from = {0, 1.1, 9}, .look_at = {0, 0, 7}, .vfov = 50};
  scene.background = Vec3d{0, 0, 0};
  scene.render.max_depth = 3;
  scene.materials = {Material{"floor", Vec3d{0.6, 0.6, 0.6}, Lambertian<>{}}};
  for (int k = 0; k < 4; ++k)
    scene.materials.push_back(Material{"lamp" + std::to_string(k), std::ldexp(1.0, k) * Vec3d{30, 25, 20}, Light<>{}});
  Object floor;
  floor.kind = Solid3d{Quad<>{{-10, 0, -10}, {20, 0, 0}, {0, 0, 20}}, 0};
  scene.objects = {floor};
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };  // in [0, 1)
  const auto place = [&](double height) {
    const double x = 18 * uniform() - 9, z = 18 * uniform() - 9;
    return Vec3d{x, height, z};
  };
  for (int i = 0; i < 12; ++i) scene.objects.push_back(sphere(place(0.5), 0.5, 0));
  for (int i = 0; i < count; ++i) {
    const double height = 1.2 + 1.5 * uniform(), size = 0.5 + uniform();
    scene.objects.push_back(sphere(place(height), 0.3 * size / std::sqrt(count), 1 + i % 4));
  }
  return scene;
}

/// Built-in scenes of the books at small sizes, paths of at most 50 events, and scenes of many lamps.
std::vector<NamedScene> scenes() {
  std::vector<NamedScene> list;
  for (const char* name : {"cornell-box", "cornell-smoke"}) list.push_back({name, built_in(name, 256, 256)});
  for (const char* name : {"cover", "simple-light", "hollow-glass"}) list.push_back({name, built_in(name, 400, 225)});
  for (NamedScene& named : list) named.scene.render.max_depth = 50;
  list.push_back({"simple-light-grey", list[3].scene});
  for (Material& material : list.back().scene.materials)
    if (std::holds_alternative<TextureIndex>(material.colour)) material.colour = Vec3d{0.5, 0.5, 0.5};
  for (const int lamps : {10, 100, 1000, 10000})
    list.push_back({"lamps-" + std::to_string(lamps), floor_beneath_lights(lamps)});
  return list;
}

/// What one process has rendered.
struct Run {
  double seconds, rel_mse;
};

/// A scene in a file, rendered by processes, and its reference.
class Task {
 public:
  Task(const Scene& scene, std::uint32_t reference_spp, const fs::path& folder)
      : reference_(test::reference_of(scene, reference_spp)), folder_(folder) {
    test::write_text(folder / "scene.json", write_scene(scene));
  }

  Run render(const fs::path& program, std::uint32_t spp, int seed = 0) const {
    ChildPlan plan;
    plan.command = {program.string(),
                    "render",
                    "scene.json",
                    "-q",
                    "-o",
                    "image.pfm",
                    "--stats",
                    "stats.json",
                    "--spp",
                    std::to_string(spp),
                    "--seed",
                    std::to_string(seed),
                    "-t",
                    std::to_string(two_threads())};
    plan.folder = folder_;
    plan.seconds = 3600;
    const ChildEnd end = run_child(plan);
    if (!end.succeeded()) throw WrongResult(program.string() + " render failed: " + end.errors);
    const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "stats.json"));
    return {stats["seconds_render"], test::true_relative_mse(read_image(folder_ / "image.pfm").rgb, reference_)};
  }

  /// Mean of relMSE times samples over some seeds.
  double quality(const fs::path& program, std::uint32_t spp) const {
    constexpr int seeds = 4;
    double sum = 0;
    for (int seed = 1; seed <= seeds; ++seed) sum += spp * render(program, spp, seed).rel_mse / seeds;
    return sum;
  }

  /// The smallest number of samples with an error of at most `target`; 0: there is none up to 4096.
  std::uint32_t crossing(const fs::path& program, double target) const {
    constexpr std::uint32_t maximum = 4096;
    std::uint32_t below = 0, spp = 1;
    while (render(program, spp).rel_mse > target) {
      if (spp >= maximum) return 0;
      below = spp, spp *= 2;
    }
    while (spp - below > 1) {
      const std::uint32_t middle = std::midpoint(below, spp);
      (render(program, middle).rel_mse > target ? below : spp) = middle;
    }
    return spp;
  }

 private:
  test::Reference reference_;
  fs::path folder_;
};

/// The seconds of each program in so many rounds. Each begins some rounds, because the machine is warmer for the next.
std::vector<std::vector<double>> seconds_of_rounds(const Task& task, const std::vector<fs::path>& programs,
                                                   const std::vector<std::uint32_t>& spp, int rounds) {
  std::vector<std::vector<double>> seconds(programs.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < programs.size(); ++k) {
      const std::size_t turn = (k + static_cast<std::size_t>(round)) % programs.size();
      if (spp[turn]) seconds[turn].push_back(task.render(programs[turn], spp[turn]).seconds);
    }
  return seconds;
}

}  // namespace

void measure_accuracy(const Settings& settings) {
  std::vector<fs::path> programs{fs::read_symlink("/proc/self/exe").parent_path() / "tyndall"};
  if (!settings.against.empty()) programs.push_back(fs::absolute(settings.against));
  std::vector<std::string> headings{"scene"};
  for (const fs::path& program : programs)
    for (const char* heading : {" spp", " seconds", " V at 64"})
      headings.push_back((&program == &programs[0] ? "our" : "their") + std::string(heading));
  const int rounds = settings.quick ? 3 : 9;
  const std::uint32_t reference_spp = settings.quick ? 512 : 4096;
  const Table table("Accuracy: samples and seconds to relMSE 0.01, " + std::to_string(two_threads()) +
                        " threads, defaults; against " + std::to_string(reference_spp) + " samples; median of " +
                        std::to_string(rounds) + " renders in turns; V = relMSE x spp",
                    headings);
  const fs::path folder = scratch_folder("bench");
  for (const NamedScene& named : scenes()) {
    const Task task(named.scene, reference_spp, folder);
    std::vector<std::uint32_t> spp;
    for (const fs::path& program : programs) spp.push_back(task.crossing(program, 0.01));
    const auto seconds = seconds_of_rounds(task, programs, spp, rounds);
    std::vector<std::string> cells{named.name};
    for (std::size_t k = 0; k < programs.size(); ++k)
      cells.insert(cells.end(), {cell(spp[k], 0), cell(median(seconds[k]), 4), cell(task.quality(programs[k], 64), 3)});
    table.add(cells);
  }
}

}  // namespace tyndall::bench

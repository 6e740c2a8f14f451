#include "core/accuracy/error.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/bench/bench.h"
#include "tests/bench/machine.h"
#include "tests/bench/measure.h"
#include "tests/bench/process.h"
#include "tests/bench/references.h"

#include <array>
#include <fstream>
#include <numeric>
#include <utility>

namespace tyndall::bench {
namespace {

namespace fs = std::filesystem;

/// What one process has rendered.
struct Run {
  double seconds, samples_per_s, rays_per_s, rel_mse;
};

/// A scene in a file, rendered by processes, and its reference.
class Task {
 public:
  Task(const NamedScene& named, int reference_spp, const fs::path& references, const fs::path& scratch)
      : reference_(reference_image(named, reference_spp, references)), scratch_(scratch) {
    const bool by_name = named.name == "next-week";  // its textures lie beside its file
    words_ = {by_name ? named.name : (scratch_ / "scene.json").string(), "--size",
              std::to_string(named.scene.width) + "x" + std::to_string(named.scene.height)};
    Scene scene = named.scene;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) scene.materials[i].name = "m" + std::to_string(i);
    std::ofstream(scratch_ / "scene.json") << write_scene(scene);
  }

  Run render(const fs::path& program, std::uint32_t spp) const {
    const fs::path image = scratch_ / "image.pfm", stats = scratch_ / "stats.json";
    std::vector<std::string> command = {program.string(), "render", "-q", "-o", image.string()};
    for (const auto& [option, value] :
         {std::pair("--spp", std::to_string(spp)), std::pair("-t", std::to_string(threads_up_to(2))),
          std::pair("--stats", stats.string())})
      command.push_back(option), command.push_back(value);
    command.insert(command.end(), words_.begin(), words_.end());
    const bool well = run_process(command);
    if (!well) throw WrongResult(program.string() + " render failed");
    const Json told = Json::parse(std::ifstream(stats));
    const double error = image_error(read_image(image).rgb, reference_.rgb).rel_mse - reference_.rel_mse;
    return {told["seconds_render"], told["msamples_per_s"], told["mrays_per_s"], error};
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
  Reference reference_;
  fs::path scratch_;
  std::vector<std::string> words_;  // what is rendered
};

/// A figure of both programs, theirs first, and the median of what it was in pairs of renders: theirs over ours.
struct Pairs {
  std::array<std::vector<double>, 2> values;
  std::vector<double> ratios;
  void add(double theirs, double ours) {
    values[0].push_back(theirs), values[1].push_back(ours), ratios.push_back(theirs / ours);
  }
};

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> list = book_scenes();
  list.push_back({"next-week", built_in("next-week", 200, 200)});
  list.push_back({"showroom", built_in("showroom", 320, 180)});
  list.push_back({"stress-white-room", built_in("stress-white-room", 200, 150)});
  list.push_back({"46-spheres", forty_six_spheres()});
  for (const int lamps : {10, 100, 1000, 10000})
    list.push_back({"lamps-" + std::to_string(lamps), floor_beneath_lights(lamps)});
  return list;
}

Json row_of(const NamedScene& named, const Task& task, const std::array<fs::path, 2>& programs, double target,
            int repeat) {
  std::array<std::uint32_t, 2> spp{};
  for (std::size_t i = 0; i < 2; ++i) spp[i] = task.crossing(programs[i], target);
  Pairs seconds, samples, rays;
  for (int i = 0; i < repeat && spp[0] && spp[1]; ++i) {
    std::array<Run, 2> run{};
    // Each begins every second pair, because the machine is warmer for the second one.
    for (const std::size_t k : {i % 2 ? 1u : 0u, i % 2 ? 0u : 1u}) run[k] = task.render(programs[k], spp[k]);
    seconds.add(run[0].seconds, run[1].seconds);
    samples.add(run[0].samples_per_s, run[1].samples_per_s);
    rays.add(run[0].rays_per_s, run[1].rays_per_s);
  }
  Json row;
  row["scene"] = named.name;
  row["width"] = named.scene.width, row["height"] = named.scene.height;
  row["target"] = target;
  row["threads"] = threads_up_to(2);
  const auto tell = [&](const std::string& name, const Pairs& pairs) {
    if (pairs.ratios.empty()) return;
    row["their_" + name] = median(pairs.values[0]), row[name] = median(pairs.values[1]);
    row[name + "_ratio"] = median(pairs.ratios);
  };
  row["their_spp"] = spp[0], row["spp"] = spp[1];
  tell("seconds", seconds), tell("msamples_per_s", samples), tell("mrays_per_s", rays);
  return row;
}

}  // namespace

Json measure_against(const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : settings.quick ? 3 : 9;
  const int reference_spp = settings.quick ? 512 : 4096;
  Table table("Against: another program beside this one, " + std::to_string(threads_up_to(2)) +
                  " threads, defaults; medians of " + std::to_string(repeat) + " pairs; ratios: theirs over ours",
              {{"scene", "scene", -1, 17},
               {"target", "target", 3},
               {"their_spp", "their spp", 0},
               {"spp", "spp", 0, 5},
               {"their_seconds", "their seconds", 4},
               {"seconds", "seconds", 4},
               {"seconds_ratio", "ratio", 2},
               {"their_msamples_per_s", "their Ms/s", 2},
               {"msamples_per_s", "Ms/s", 2, 6},
               {"their_mrays_per_s", "their Mrays/s", 1},
               {"mrays_per_s", "Mrays/s", 1}});
  const fs::path own = find_tyndall();
  if (settings.against.empty() || own.empty()) {
    print_note(own.empty() ? "not measured: there is no program \"tyndall\" beside this one; build it first"
                           : "not measured: --against names no other program");
    return table.rows();
  }
  const std::array<fs::path, 2> programs{fs::absolute(settings.against), own};
  const ScratchFolder scratch;
  for (const NamedScene& named : scenes()) {
    const Task task(named, reference_spp, settings.references, scratch.path());
    table.add(row_of(named, task, programs, 0.01, repeat));
    if (settings.thorough) table.add(row_of(named, task, programs, 0.001, repeat));
  }
  return table.rows();
}

}  // namespace tyndall::bench

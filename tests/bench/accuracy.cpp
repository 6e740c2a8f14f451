#include "core/accuracy/error.h"
#include "tests/bench/bench.h"
#include "tests/bench/machine.h"
#include "tests/bench/measure.h"
#include "tests/bench/references.h"
#include "tests/support/prepared.h"

#include <numeric>

namespace tyndall::bench {

using namespace test;
namespace {

/// How much is done; --quick does less.
struct Effort {
  int reference_spp, seeds, repeat;
};

Effort effort_of(const Settings& settings) {
  Effort effort = settings.quick ? Effort{512, 2, 3} : Effort{4096, 4, 5};
  if (settings.thorough) effort.reference_spp = 4096;  // a reference's own error must be small beside the target
  if (settings.repeat > 0) effort.repeat = settings.repeat;
  return effort;
}

/// Renders of one scene, and how far they are from its reference.
class Contest {
 public:
  Contest(const NamedScene& named, const Effort& effort, const Settings& settings)
      : scene_(named.scene), reference_(reference_image(named, effort.reference_spp, settings.references)) {
    scene_.render.integrator = Integrator::mis;
    scene_.render.sampler = SamplerKind::sobol;
    use_seed(0);
  }

  void use_seed(std::uint32_t seed) {
    scene_.render.seed = seed;
    compiled_ = compile(scene_);
  }

  /// The film with spp samples a pixel, made anew or out of one with fewer.
  Film film(std::uint32_t spp, Film begun = {}) const {
    return render(compiled_, {.threads = threads(), .spp = spp}, {}, std::move(begun)).film;
  }
  /// The reference's own noise taken off.
  double rel_mse(const Film& film) const {
    return image_error(resolve(film), reference_.rgb).rel_mse - reference_.rel_mse;
  }
  static int threads() { return threads_up_to(2); }

 private:
  Scene scene_;
  Reference reference_;
  RenderScene compiled_;
};

/// Where the error falls to the target.
struct Crossing {
  std::uint32_t spp = 0;
  double rel_mse = 0;
  bool found = false;
};

/// The smallest number of samples with an error of at most `target`, found by doubling, and then by bisection.
Crossing find_crossing(const Contest& contest, double target) {
  constexpr std::uint32_t maximum = 4096;
  std::uint32_t below = 0, spp = 1;
  Film film = contest.film(spp);
  double error = contest.rel_mse(film);
  while (error > target && spp < maximum) {
    below = spp;
    film = contest.film(spp *= 2, std::move(film));
    error = contest.rel_mse(film);
  }
  Crossing crossing{spp, error, error <= target};
  while (crossing.found && crossing.spp - below > 1) {
    const std::uint32_t middle = std::midpoint(below, crossing.spp);
    error = contest.rel_mse(contest.film(middle));
    if (error <= target)
      crossing.spp = middle, crossing.rel_mse = error;
    else
      below = middle;
  }
  return crossing;
}

/// Mean of relMSE times samples over several seeds.
double quality(Contest& contest, std::uint32_t spp, int seeds) {
  double sum = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    contest.use_seed(static_cast<std::uint32_t>(seed));
    sum += contest.rel_mse(contest.film(spp)) * spp;
  }
  return sum / seeds;
}

Json row_of(const NamedScene& named, const Effort& effort, double target, const Settings& settings) {
  Contest contest(named, effort, settings);
  const Crossing crossing = find_crossing(contest, target);
  std::vector<double> seconds;
  for (int i = 0; crossing.found && i < effort.repeat; ++i) {
    Film film;  // outside of the measured call, so that freeing its memory is not measured
    seconds.push_back(seconds_of([&] { film = contest.film(crossing.spp); }));
  }
  Json row;
  row["scene"] = named.name;
  row["width"] = named.scene.width, row["height"] = named.scene.height;
  row["integrator"] = "mis", row["sampler"] = "sobol";
  row["threads"] = Contest::threads();
  row["reference_spp"] = effort.reference_spp;
  row["target"] = target;
  row["spp"] = crossing.found ? Json(crossing.spp) : Json(nullptr);
  row["rel_mse"] = crossing.rel_mse;
  row["median_seconds"] = crossing.found ? Json(median(seconds)) : Json(nullptr);
  row["v16"] = quality(contest, 16, effort.seeds);
  row["v64"] = quality(contest, 64, effort.seeds);
  row["seconds"] = seconds;
  return row;
}

}  // namespace

Json measure_accuracy(const Settings& settings) {
  const Effort effort = effort_of(settings);
  Table table("Accuracy: " + std::to_string(Contest::threads()) + " threads, mis, sobol, against " +
                  std::to_string(effort.reference_spp) + " samples; median of " + std::to_string(effort.repeat) +
                  " renders; V = relMSE x spp",
              {{"scene", "scene", -1, 17},
               {"target", "target", 3},
               {"spp", "spp", 0, 5},
               {"rel_mse", "relMSE", 5, 7},
               {"median_seconds", "seconds", 4},
               {"v16", "V at 16", 3},
               {"v64", "V at 64", 3}});
  for (const NamedScene& named : book_scenes()) {
    table.add(row_of(named, effort, 0.01, settings));
    if (settings.thorough) table.add(row_of(named, effort, 0.001, settings));
  }
  return table.rows();
}

}  // namespace tyndall::bench

#pragma once
#include "core/accuracy/estimate.h"
#include "core/base/seconds.h"
#include "core/compile/render_scene.h"
#include "core/render/pass.h"
#include "core/render/single_pixels.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

/// A picture in the making. Blocking and interactive renders are both loops around Progression::run_pass(). This is the
/// only place that decides which samples come next and when the picture is finished, and measures the time and the
/// error. No decision changes a sample, so that pictures do not depend on speed or interruptions.
namespace tyndall {

/// Limits of a picture: it is finished at the first one that it reaches.
struct Limits {
  std::optional<std::uint32_t> spp;  ///< samples a pixel, with adaptive sampling their mean; absent: no limit
  double seconds = std::numeric_limits<double>::infinity();  ///< of rendering; checked between passes, after the first
  double error = 0;  ///< estimated relative error; checked likewise; 0: no limit
};

/// Number of samples a pixel that each pass takes. The first pass takes one.
struct PassLength {
  double growth = 1;           ///< samples of a pass over those taken before: 1 doubles them, 0.25 adds a quarter
  std::uint32_t maximum = 32;  ///< samples of the longest pass
  double seconds =
      std::numeric_limits<double>::infinity();  ///< about the longest duration of a pass, by the last one's speed
  /// A pass takes at least as many samples as fit into this time: each pass reads and writes the whole film once, which
  /// costs as much as half a sample of a simple scene.
  double min_seconds = 0;
};

/// Samples of the next pass, at least 1. taken: samples a pixel so far; paths_per_second: <= 0 if unknown.
std::uint32_t pass_samples(const PassLength& length, std::uint32_t taken, std::size_t pixels, double paths_per_second);

/// When to estimate the error of a film, which takes about as long as drawing the picture. It is always done when the
/// wanted number of samples is reached; these members add earlier estimates.
struct EstimateTimes {
  /// The first estimate is due after this time of rendering. After one at t seconds, the next is due at
  /// t + seconds + growth · t.
  double seconds = std::numeric_limits<double>::infinity();
  double growth = 0;
  std::uint32_t each_below = 0;  ///< below this number of samples a pixel, every pass is followed by an estimate
};

/// How to make a picture.
struct ProgressionOptions {
  bool adaptive = false;  ///< see plan.h
  int tile = 0;           ///< see Tiling
  /// Above 1: the first pass takes one sample of every coarse_step-th pixel in x and y. With a slow source of samples
  /// further coarse passes follow, see is_slow_source(): then it is a power of two.
  int coarse_step = 1;
  double quantum = 0;  ///< of the film; 0: the scene's
  bool clear = false;  ///< the film is cleared first: see Progression::is_filling()
  /// The part of the picture that gets all further samples once each pixel has one, until it has the wanted number;
  /// then the rest follows. Empty: none. No effect with `adaptive`, which distributes the samples itself.
  Region first{};
  bool count_breaks = false;  ///< the time between passes counts as rendering time, as in blocking renders
  PassLength length{};
  EstimateTimes estimates{};
};

/// Counts and times since the start.
struct PassTally {
  std::uint64_t rays = 0, shadow_rays = 0, splits = 0;     ///< up to now
  std::uint64_t samples = 0, rejected = 0, truncated = 0;  ///< of whole passes, and of the continued film
  double seconds = 0;  ///< up to the last film write, or up to now while a pass runs
  double last_mrays_per_s = 0, last_paths_per_second = 0;  ///< of the last whole pass; 0: there was none
};

/// A film and the passes that fill it, in this order: the rest of an interrupted pass; a coarse pass; the pixels that
/// it left out; the part to refine first; then passes that grow, but never beyond the end of a round of adaptive
/// sampling.
class Progression {
 public:
  /// Starts a picture of the scene, without samples. Reuses the film's memory if the size is the same. Changes nothing
  /// if it throws std::bad_alloc.
  void start(const RenderScene& scene, const Region& region, std::uint32_t first_sample,
             const ProgressionOptions& options);
  /// Continues a film that was rendered from the same scene with the same `adaptive`. Pixels that an interrupted pass
  /// left uneven are made even first.
  void go_on(Film film, const ProgressionOptions& options);

  /// Estimates the error of the present film, if it has two samples a pixel. If `give_up` is set meanwhile, the
  /// estimate uses the film alone (see ask_levels()).
  void estimate_now(const RenderEngine& engine, const std::atomic<bool>& give_up);

  /// Whether the picture is finished.
  bool reached(const Limits& limits) const;
  /// Takes samples until the next pass is complete, and returns true. If `give_up` is set meanwhile, it returns false
  /// within one tile job, about 2 ms; the next call then continues that pass. Estimates the error if that is due. poll:
  /// see ThreadPool::for_each.
  bool run_pass(const RenderEngine& engine, const Limits& limits, const std::atomic<bool>& give_up,
                const std::function<void()>& poll = {});

  const Film& film() const { return film_; }
  /// Known levels of the film's pixels.
  PixelLevels& levels() { return levels_; }
  Film take_film() { return std::move(film_); }
  /// Gives back the film that take_film() returned, unchanged.
  void put_back(Film film) { film_ = std::move(film); }
  /// Samples that every pixel has; with adaptive sampling their mean. 0 while only a coarse pass exists.
  std::uint32_t taken() const { return schedule_.taken; }
  /// Samples of the pixels that were refined first; taken() where there are none.
  std::uint32_t max_taken() const { return std::max(schedule_.taken, schedule_.max); }
  /// See ProgressionOptions; from the next pass on.
  void set_first(const Region& first) { options_.first = first; }
  /// Whether there is a picture to show.
  bool has_picture() const { return taken() > 0 || schedule_.coarse_done > 0; }
  /// 1, or larger after a coarse pass and before the first one: only every step-th pixel in x and y has samples then.
  int step() const {
    if (taken() > 0) return 1;
    return schedule_.coarse_done > 0 ? schedule_.coarse_done : options_.coarse_step;
  }
  /// Whether a pass was interrupted that gives the pixels beside those of a coarse pass their first samples, in a film
  /// that was cleared before: pixels without samples have none yet.
  bool is_filling() const { return options_.clear && taken() == 0 && within_pass() && schedule_.coarse == 0; }
  /// Whether a pass was interrupted and is not complete.
  bool within_pass() const { return schedule_.pass != nullptr; }
  /// May be called from run_pass()'s poll.
  PassTally tally() const;
  /// Light lost by ending paths at max_depth: see FilmTotals::cut_throughput.
  double cut_throughput() const;
  /// Estimated relative error; infinite before two samples.
  double error() const { return estimate_.relative_error; }
  /// The estimate that holds error().
  const ErrorEstimate& estimate() const { return estimate_; }
  /// Whether estimate() is that of the present film.
  bool estimate_is_new() const { return estimate_of_ == taken() && taken() >= 2 && !within_pass(); }

 private:
  /// Where the picture stands between the passes that it needs.
  struct Schedule {
    std::unique_ptr<Pass> pass;  ///< null between passes
    int coarse = 0;              ///< step of the present pass, if it is a coarse one; else 0
    int coarse_done = 0;         ///< step of the finest coarse pass that is complete; 0: there was none
    bool refining = false;       ///< the pass is one over the part to refine first
    bool replaces = false;       ///< the pass replaces the samples of the coarse one
    std::uint32_t taken = 0;     ///< samples of every pixel; after adaptive rounds their mean
    std::uint32_t end = 0;       ///< the same after the present pass
    std::uint32_t max = 0;       ///< if above `taken`: samples of the pixels that were refined first
    std::uint32_t level_to = 0;  ///< samples that an interrupted pass gave to some pixels: all get these first; 0: none
  };
  void begin(const ProgressionOptions& options);
  void start_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit);
  int next_step(const RenderEngine& engine) const;
  Tiling tiling_for(const RenderEngine& engine) const;
  std::unique_ptr<Pass> pass_to(std::uint32_t samples, const Region& part, const Tiling& tiling) const;
  std::unique_ptr<Pass> full_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit);
  std::unique_ptr<Pass> refining_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit);
  bool estimate_is_due(const Limits& limits) const;
  void finish_pass();

  Film film_;
  ProgressionOptions options_;
  Schedule schedule_;
  PassTally tally_;
  Clock::time_point last_write_;
  std::optional<Clock::time_point> running_from_;  ///< set while run_pass() runs: start of the time to add
  double pass_seconds_ = 0;                        ///< spent on the current pass
  PixelLevels levels_;
  ErrorEstimate estimate_;
  std::uint32_t estimate_of_ = 0;  ///< samples a pixel of the estimated film
  double next_estimate_ = 0;       ///< time of the next one, in seconds of rendering
};

}  // namespace tyndall

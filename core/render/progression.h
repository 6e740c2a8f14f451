#pragma once
#include "core/accuracy/estimate.h"
#include "core/compile/render_scene.h"
#include "core/render/pass.h"
#include "core/render/single_pixels.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

/// A picture in the making. Blocking and interactive renders are both loops around Progression::run_pass(). Here alone
/// it is decided which samples come next and when the picture is finished, and measured how long it took and how far
/// the picture is from the truth. No decision changes a sample, so pictures do not depend on speed or on interruptions.
namespace tyndall {

/// Where a picture is finished: at the first of these.
struct Limits {
  std::optional<std::uint32_t> spp;  ///< samples a pixel, with adaptive sampling their mean; absent: no limit
  double seconds =
      std::numeric_limits<double>::infinity();  ///< of rendering; looked at between passes, after the first
  double error = 0;                             ///< estimated relative error; looked at likewise; 0: no limit
};

/// How many samples a pixel each pass takes. The first pass takes one.
struct PassLength {
  double growth = 1;           ///< samples of a pass over those that are there: 1 doubles them, 0.25 adds a quarter
  std::uint32_t maximum = 32;  ///< samples of the longest pass
  double seconds =
      std::numeric_limits<double>::infinity();  ///< about how long a pass may take, by the last one's speed
  /// A pass takes as many samples as fit into this time, if these are more than `growth` says: each pass goes through
  /// the whole film once, which costs as much as half a sample of a simple scene.
  double min_seconds = 0;
};

/// Samples of the next pass, at least 1. taken: samples a pixel so far; paths_per_second: <= 0 if unknown.
std::uint32_t pass_samples(const PassLength& length, std::uint32_t taken, std::size_t pixels, double paths_per_second);

/// When the error of a film is estimated, which takes about as long as drawing the picture. It always is when the
/// wanted number of samples is reached; these members say how often before.
struct EstimateTimes {
  /// The first estimate is due after this time of rendering. After one at t seconds, the next is due at
  /// t + seconds + growth · t.
  double seconds = std::numeric_limits<double>::infinity();
  double growth = 0;
  std::uint32_t each_below = 0;  ///< with fewer samples a pixel than this, an estimate follows every pass
};

/// How a picture is made.
struct ProgressionOptions {
  bool adaptive = false;  ///< see plan.h
  int tile = 0;           ///< see Tiling
  int coarse_step = 1;    ///< above 1: the first pass takes one sample of every coarse_step-th pixel in x and y
  /// The part of the picture that gets all further samples as soon as each pixel has one, until it has as many as are
  /// wanted; then the rest follows. Empty: none. Of no effect with `adaptive`, which says by itself where samples go.
  Region first;
  bool count_breaks = false;  ///< the time between passes counts as rendering time, as in blocking renders
  PassLength length;
  EstimateTimes estimates;
};

/// Decides which samples of a film come next. In this order: what an interrupted pass has left; a coarse pass; the
/// pixels that it left out; the part that is refined first; then passes that grow, but never beyond the end of a round
/// of adaptive sampling.
class PassSchedule {
 public:
  /// For a film that has no samples, or whose samples are replaced by the first pass.
  explicit PassSchedule(const ProgressionOptions& options = {}) : options_(options) {}
  /// Goes on with a film's samples. Those that an interrupted pass left uneven are made even first.
  PassSchedule(const ProgressionOptions& options, const Film& film);

  /// Returns the pass that was interrupted, or else begins a new one. limit: see Limits::spp; paths_per_second: see
  /// pass_samples().
  Pass& next(Film& film, std::optional<std::uint32_t> limit, double paths_per_second, const RenderEngine& engine);
  /// To be called when all units of the pass are done.
  void finish();
  /// See ProgressionOptions; from the next pass on.
  void set_first(const Region& first) { options_.first = first; }

  const Pass* pass() const { return pass_.get(); }  ///< null between passes
  bool replaces() const { return replaces_; }       ///< whether the pass replaces the samples of the coarse one
  std::uint32_t taken() const { return taken_; }    ///< samples of every pixel; after adaptive rounds their mean
  std::uint32_t maximum() const { return std::max(taken_, max_); }  ///< samples of those that were refined first
  bool coarse_done() const { return coarse_done_; }
  int coarse_step() const { return options_.coarse_step; }

 private:
  std::unique_ptr<Pass> full_pass(Film& film, std::optional<std::uint32_t> limit, double paths_per_second,
                                  const RenderEngine& engine);
  std::unique_ptr<Pass> refining_pass(const Film& film, std::optional<std::uint32_t> limit, double paths_per_second,
                                      const RenderEngine& engine);

  ProgressionOptions options_;
  std::unique_ptr<Pass> pass_;
  bool coarse_ = false, coarse_done_ = false, refining_ = false, replaces_ = false;
  std::uint32_t taken_ = 0, end_ = 0;
  std::uint32_t max_ = 0;       ///< above taken_: so many samples have pixels that were refined first
  std::uint32_t level_to_ = 0;  ///< an interrupted pass left some pixels with so many: all get these first; 0: none did
};

/// What was counted since the start, and how long it took.
struct PassTally {
  std::uint64_t rays = 0, shadow_rays = 0;                 ///< up to now
  std::uint64_t samples = 0, rejected = 0, truncated = 0;  ///< of whole passes, and of the film that was continued
  double seconds = 0;  ///< up to the last film write, or up to now while a pass runs
  double last_mrays_per_s = 0, last_paths_per_second = 0;  ///< of the last whole pass; 0: there was none
};

/// A film and the passes that fill it.
class Progression {
 public:
  /// Begins a picture of the scene, without samples. Uses the film's memory again if the size is the same. If it throws
  /// std::bad_alloc, nothing has changed.
  void start(const RenderScene& scene, const Region& region, std::uint32_t first_sample,
             const ProgressionOptions& options);
  /// Goes on with a film that was rendered from the same scene with the same `adaptive`.
  void go_on(Film film, const ProgressionOptions& options);

  /// Estimates the error of the film as it is, if it has two samples a pixel. If `give_up` is set meanwhile, it is
  /// found from the film alone (see ask_levels()).
  void estimate_now(const RenderEngine& engine, const std::atomic<bool>& give_up);

  /// Whether the picture is finished.
  bool reached(const Limits& limits) const;
  /// Takes samples until the next pass is complete, and returns true. If `give_up` is set meanwhile it returns false
  /// within one tile job, about 2 ms; the next call then goes on with that pass. Estimates the error if that is due.
  /// poll: see ThreadPool::for_each.
  bool run_pass(const RenderEngine& engine, const Limits& limits, const std::atomic<bool>& give_up,
                const std::function<void()>& poll = {});

  const Film& film() const { return film_; }
  /// What is known of its pixels' levels.
  PixelLevels& levels() { return levels_; }
  Film take_film() { return std::move(film_); }
  /// Gives back the film that take_film() returned, unchanged.
  void put_back(Film film) { film_ = std::move(film); }
  /// Samples that every pixel has; with adaptive sampling their mean. 0 while only a coarse pass is there.
  std::uint32_t taken() const { return schedule_.taken(); }
  /// Samples of the pixels that were refined first; taken() where there are none.
  std::uint32_t max_taken() const { return schedule_.maximum(); }
  /// See ProgressionOptions; from the next pass on.
  void set_first(const Region& first);
  /// Whether there is something to show.
  bool has_picture() const { return taken() > 0 || schedule_.coarse_done(); }
  /// 1, or larger after a coarse pass: then only every step-th pixel in x and y has samples.
  int step() const { return taken() == 0 ? schedule_.coarse_step() : 1; }
  /// Whether a pass was interrupted and is not complete.
  bool within_pass() const { return schedule_.pass() != nullptr; }
  /// May be called from run_pass()'s poll.
  PassTally tally() const;
  /// What was lost by cutting paths at the largest depth: see FilmTotals::cut_throughput.
  double cut_throughput() const;
  /// Estimated relative error; infinite before two samples.
  double error() const { return estimate_.relative_error; }
  /// The estimate that error() is taken from.
  const ErrorEstimate& estimate() const { return estimate_; }
  /// Whether estimate() is of the film as it is now.
  bool estimate_is_new() const { return estimate_of_ == taken() && taken() >= 2 && !within_pass(); }

 private:
  using Clock = std::chrono::steady_clock;
  void begin(PassSchedule schedule, const ProgressionOptions& options);
  bool estimate_is_due(const Limits& limits) const;
  void finish_pass();

  Film film_;
  ProgressionOptions options_;
  PassSchedule schedule_;
  PassTally tally_;
  Clock::time_point last_write_;
  std::optional<Clock::time_point> running_from_;  ///< set while run_pass() runs: its time counts from then on
  double pass_seconds_ = 0;                        ///< seconds spent on the pass that is under way
  PixelLevels levels_;
  ErrorEstimate estimate_;
  std::uint32_t estimate_of_ = 0;  ///< samples a pixel that the estimate was made from
  double next_estimate_ = 0;       ///< when the next one is due, in seconds of rendering
};

}  // namespace tyndall

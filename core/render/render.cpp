#include "core/render/render.h"

#include "core/base/seconds.h"
#include "core/render/clean_film.h"
#include "core/render/plan.h"
#include "core/render/progression.h"

#include <utility>

namespace tyndall {
namespace {

double millions(std::uint64_t count) { return static_cast<double>(count) * 1e-6; }

ProgressionOptions progression_options(const RenderOptions& options, bool reports) {
  ProgressionOptions made;
  made.adaptive = options.adaptive;
  made.tile = options.tile;
  if (options.samples) made.quantum = source_quantum;
  made.count_breaks = true;
  // If time or error decide when to stop, passes are short, because both are checked between passes only. Otherwise
  // there are few passes: each doubles the samples, or takes a tenth of a second, up to PassLength::maximum.
  const bool looks = options.target_error > 0 || options.time_limit < std::numeric_limits<double>::infinity();
  made.length.growth = looks ? 0.25 : 1;
  made.length.min_seconds = looks ? 0 : 0.1;
  if (reports) made.estimates = {.seconds = 0.5, .growth = 0.5};
  return made;
}

/// A render, from its first pass to its result.
class Rendering {
 public:
  Rendering(const PreparedScene& scene, const RenderOptions& options, const ProgressCallback& progress, Film film)
      : options_(options),
        progress_(progress),
        kernels_(kernels_of(options.isa)),
        limits_{options.spp, options.time_limit, options.clean ? 0 : options.target_error},
        view_(scene.view()),
        cleaner_(kernels_) {
    const ProgressionOptions how = progression_options(options, progress != nullptr);
    const RenderScene& columns = scene.columns();
    const Region whole{0, 0, columns.width, columns.height};
    if (film.pixels.empty())
      picture_.start(columns, options.region.value_or(whole), options.first_sample, how);
    else
      picture_.go_on(std::move(film), how);
    thread_pool_.emplace(options.threads);
    engine_.emplace(RenderEngine{*thread_pool_, kernels_, view_, options.samples.get()});
  }

  RenderResult run() {
    while (!finished()) {
      give_up_ = false;
      const bool whole = picture_.run_pass(*engine_, limits_, give_up_, [&] { look(); });
      if (whole) look();
      if (!finished()) take_breaks();
    }
    return result();
  }

 private:
  /// Limits are checked between passes only, also where a pass is interrupted for a break.
  bool finished() { return stopped_ || (!picture_.within_pass() && (picture_.reached(limits_) || clean_is_good())); }

  /// Whether the clean view's error is small enough to stop. It is made of the finished film; if its error decides when
  /// to stop, also now and then before, so seldom that this takes at most a quarter of the time.
  bool clean_is_good() {
    if (!options_.clean || options_.target_error <= 0 || picture_.taken() < min_clean_spp) return false;
    if (cleaned_ != picture_.taken() && clean_seconds_ <= picture_.tally().seconds / 4) clean(picture_.film());
    return cleaned_ == picture_.taken() && clean_.relative_error <= options_.target_error;
  }
  void clean(const Film& film) {
    const auto start = std::chrono::steady_clock::now();
    cleaner_.run(film, *engine_, &picture_.levels(), never_, clean_);
    clean_seconds_ += seconds_since(start);
    cleaned_ = picture_.taken();
  }

  /// Reports progress and finds out what is due. Called while a pass runs, and after each pass.
  void look() {
    const RenderBreaks& breaks = options_.breaks;
    film_due_ = film_due_ || (breaks.film_due && breaks.film_due());
    result_due_ = result_due_ || (breaks.result_due && breaks.result_due());
    if (progress_) report();
    if (film_due_ || result_due_ || stopped_) give_up_ = true;
  }
  void report() {
    const PassTally tally = picture_.tally();
    const double rate = tally.seconds > 0 ? millions(tally.rays) / tally.seconds : 0;
    const double error = options_.clean && options_.target_error > 0 ? clean_.relative_error : picture_.error();
    if (!progress_({picture_.taken(), tally.seconds, rate, error})) stopped_ = true;
  }

  void take_breaks() {
    if (std::exchange(film_due_, false)) options_.breaks.take_film(picture_.film(), *thread_pool_);
    if (!std::exchange(result_due_, false)) return;
    RenderResult so_far = result();
    options_.breaks.take_result(so_far);
    picture_.put_back(std::move(so_far.film));
  }

  /// Moves the film out of the picture into a result.
  RenderResult result() {
    RenderResult result;
    const PassTally tally = picture_.tally();
    result.rays = tally.rays, result.shadow_rays = tally.shadow_rays, result.split_events = tally.splits;
    result.seconds = tally.seconds;
    result.threads = thread_pool_->size();
    result.kernels = kernels_;
    result.interrupted = stopped_;
    if (progress_ && !picture_.estimate_is_new()) picture_.estimate_now(*engine_, never_);
    if (picture_.taken() >= 2 && (progress_ || picture_.estimate_is_new())) result.estimate = picture_.estimate();
    result.film = picture_.take_film();
    if (options_.clean && totals(result.film).min_taken >= min_clean_spp) {
      if (picture_.within_pass() || cleaned_ != picture_.taken()) clean(result.film);
      result.clean = std::move(clean_);
      result.seconds_clean = clean_seconds_;
      cleaned_ = 0;
    }
    if (!options_.samples) result.first_rejected = find_rejected(kernels_, view_, result.film);
    return result;
  }

  const RenderOptions& options_;
  const ProgressCallback& progress_;
  Kernels kernels_;
  Limits limits_;
  const SceneView& view_;
  Progression picture_;
  std::optional<ThreadPool> thread_pool_;
  std::optional<RenderEngine> engine_;
  FilmCleaner cleaner_;
  CleanPicture clean_;         ///< the newest one
  std::uint32_t cleaned_ = 0;  ///< samples a pixel that it was made from; 0: there is none
  double clean_seconds_ = 0;   ///< spent on all of them
  std::atomic<bool> give_up_ = false;
  const std::atomic<bool> never_ = false;
  bool stopped_ = false, film_due_ = false, result_due_ = false;
};

}  // namespace

RenderResult render(const PreparedScene& scene, const RenderOptions& options, const ProgressCallback& progress,
                    Film film) {
  return Rendering(scene, options, progress, std::move(film)).run();
}

ErrorEstimate estimate_error(const PreparedScene& scene, const Kernels& kernels, const Film& film, int threads) {
  ThreadPool thread_pool(threads);
  PixelLevels levels;
  const std::atomic<bool> never = false;
  return estimate_error(film, {thread_pool, kernels, scene.view()}, levels, never);
}

FinishedPicture finished_picture(const PreparedScene& scene, const RenderResult& result) {
  const Film& film = result.film;
  FinishedPicture picture;
  picture.totals = totals(film);
  picture.spp = labelled_spp(film, picture.totals);
  picture.estimate = result.estimate ? *result.estimate : estimate_error(film);
  picture.image = {film.region.width(), film.region.height(), resolve(film)};
  picture.hash = image_hash(picture.image.width, picture.image.height, picture.image.rgb);
  if (result.clean) picture.clean_hash = image_hash(result.clean->width, result.clean->height, result.clean->rgb);
  const std::uint32_t minimum = picture.totals.min_taken;
  picture.rare_bright_paths = has_rare_bright_paths(picture.estimate, minimum, scene.caustic_chance()) ||
                              (result.clean && is_doubtful(*result.clean, minimum));
  return picture;
}

}  // namespace tyndall

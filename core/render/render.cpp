#include "core/render/render.h"

#include "core/base/seconds.h"
#include "core/render/clean_film.h"
#include "core/render/plan.h"
#include "core/render/progression.h"

#include <stdexcept>

namespace tyndall {
namespace {

double millions(std::uint64_t count) { return static_cast<double>(count) * 1e-6; }

ProgressionOptions progression_options(const RenderOptions& options, bool reports) {
  ProgressionOptions made;
  made.adaptive = options.adaptive;
  made.tile = options.tile;
  made.count_breaks = true;
  // If time or error decide when to stop, passes are short, because both are looked at between passes only. Otherwise
  // each pass doubles the samples.
  const bool looks = options.target_error > 0 || options.time_limit < std::numeric_limits<double>::infinity();
  made.length.growth = looks ? 0.25 : 1;
  if (reports) made.estimates = {.seconds = 0.5, .growth = 0.5};
  return made;
}

Kernels kernels_of(const RenderOptions& options) {
  if (const auto kernels = choose_kernels(options.isa)) return *kernels;
  throw std::invalid_argument("no kernel for instruction set \"" + options.isa + "\"");
}

/// The clean view of a render. It is made of the finished film; if its error decides when to stop, also now and then
/// before.
class CleanView {
 public:
  CleanView(const RenderOptions& options, const RenderEngine& engine)
      : wanted_(options.clean), target_(options.target_error), engine_(engine), cleaner_(engine.kernels) {}

  /// Whether its error is small enough to stop. Filters only so often that this takes at most a quarter of the time.
  bool is_good(const Progression& picture) {
    if (!wanted_ || target_ <= 0 || picture.taken() < least_clean_spp) return false;
    if (cleaned_ != picture.taken() && seconds_ <= picture.tally().seconds / 4) make(picture.film(), picture.taken());
    return cleaned_ == picture.taken() && clean_.relative_error <= target_;
  }
  void finish(const Film& film, std::uint32_t taken, bool whole, RenderResult& result) {
    if (!wanted_ || totals(film).least_taken < least_clean_spp) return;
    if (!whole || cleaned_ != taken) make(film, taken);
    result.clean = std::move(clean_);
    result.seconds_clean = seconds_;
  }
  /// Estimated relative error of the newest clean view; infinite before the first.
  double error() const { return clean_.relative_error; }

 private:
  void make(const Film& film, std::uint32_t taken) {
    const auto start = std::chrono::steady_clock::now();
    cleaner_.run(film, engine_, false, clean_);
    seconds_ += seconds_since(start);
    cleaned_ = taken;
  }

  bool wanted_;
  double target_;
  RenderEngine engine_;
  FilmCleaner cleaner_;
  CleanPicture clean_;
  std::uint32_t cleaned_ = 0;  ///< samples a pixel that the newest clean view was made from
  double seconds_ = 0;
};

}  // namespace

RenderResult render(const RenderScene& scene, const RenderOptions& options, const ProgressCallback& progress,
                    Film film) {
  RenderResult result;
  result.kernels = kernels_of(options);
  Progression picture;
  const ProgressionOptions how = progression_options(options, progress != nullptr);
  if (film.pixels.empty())
    picture.start(scene, options.region.value_or(Region{0, 0, scene.width, scene.height}), options.first_sample, how);
  else
    picture.go_on(std::move(film), how);
  Crew crew(options.threads);
  const SceneViewOf view(scene);
  const Limits limits{options.spp, options.time_limit, options.clean ? 0 : options.target_error};
  const RenderEngine engine{crew, result.kernels, view.view()};
  CleanView clean(options, engine);
  std::atomic<bool> stop = false;
  const auto report = [&] {
    if (!progress) return;
    const PassTally tally = picture.tally();
    const double rate = tally.seconds > 0 ? millions(tally.rays) / tally.seconds : 0;
    const double error = options.clean && options.target_error > 0 ? clean.error() : picture.error();
    if (!progress({picture.taken(), tally.seconds, rate, error})) stop = true;
  };
  while (!stop && !picture.reached(limits) && !clean.is_good(picture)) {
    const bool whole = picture.run_pass(engine, limits, stop, report);
    if (whole) report();
  }
  const PassTally tally = picture.tally();
  result.rays = tally.rays, result.shadow_rays = tally.shadow_rays;
  result.seconds = tally.seconds;
  result.threads = crew.size();
  result.interrupted = stop;
  if (picture.estimate_is_new()) result.estimate = picture.estimate();
  const bool whole = !picture.within_pass();
  const std::uint32_t taken = picture.taken();
  result.film = picture.take_film();
  clean.finish(result.film, taken, whole, result);
  result.first_rejected = find_rejected(result.kernels, view.view(), result.film);
  return result;
}

FinishedPicture finished_picture(const RenderResult& result) {
  const Film& film = result.film;
  FinishedPicture picture;
  picture.totals = totals(film);
  picture.spp = labelled_spp(film, picture.totals);
  picture.estimate = result.estimate ? *result.estimate : estimate_error(film);
  picture.image = {film.region.width(), film.region.height(), resolve(film)};
  picture.hash = image_hash(picture.image.width, picture.image.height, picture.image.rgb);
  if (result.clean) picture.clean_hash = image_hash(result.clean->width, result.clean->height, result.clean->rgb);
  return picture;
}

}  // namespace tyndall

#include "core/render/render.h"

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
  // Where time or error decide, passes are short, so that a look between them comes in time. Else they double what is
  // there, so that an interrupted render has covered the whole image.
  const bool looks = options.target_error > 0 || options.time_limit < std::numeric_limits<double>::infinity();
  made.length.growth = looks ? 0.25 : 1;
  if (reports) made.estimates = {.seconds = 0.5, .growth = 0.5};
  return made;
}

Kernels kernels_of(const RenderOptions& options) {
  if (const auto kernels = choose_kernels(options.isa)) return *kernels;
  throw std::invalid_argument("no kernel for instruction set \"" + options.isa + "\"");
}

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
  const Limits limits{options.spp, options.time_limit, options.target_error};
  std::atomic<bool> stop = false;
  const auto report = [&] {
    if (!progress) return;
    const PassTally tally = picture.tally();
    const double rate = tally.seconds > 0 ? millions(tally.rays) / tally.seconds : 0;
    if (!progress({picture.taken(), tally.seconds, rate, picture.error()})) stop = true;
  };
  while (!stop && !picture.reached(limits)) {
    const bool whole = picture.run_pass({crew, result.kernels, view.view()}, limits, stop, report);
    if (whole) report();
  }
  const PassTally tally = picture.tally();
  result.rays = tally.rays, result.shadow_rays = tally.shadow_rays;
  result.seconds = tally.seconds;
  result.threads = crew.size();
  result.interrupted = stop;
  if (picture.estimate_is_new()) result.estimate = picture.estimate();
  result.film = picture.take_film();
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
  return picture;
}

}  // namespace tyndall

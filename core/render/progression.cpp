#include "core/render/progression.h"

#include "core/base/seconds.h"
#include "core/film/groups.h"
#include "core/render/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// A part of a film's region, widened so that it cuts no block of groups; empty where the two do not overlap.
Region part_of(const Film& film, const Region& part, bool reuses_paths) {
  const int across = reuses_paths ? block_width : 1, down = reuses_paths ? block_height : 1;
  const auto up = [](int at, int step) { return (at + step - 1) / step * step; };
  const Region all = film.region;
  return {std::max(std::max(part.x0, 0) / across * across, all.x0),
          std::max(std::max(part.y0, 0) / down * down, all.y0), std::min(up(std::max(part.x1, 0), across), all.x1),
          std::min(up(std::max(part.y1, 0), down), all.y1)};
}

std::uint32_t min_taken(const Film& film, const Region& part) {
  std::uint32_t minimum = film.at(part.x0, part.y0).taken;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) minimum = std::min(minimum, film.at(x, y).taken);
  return minimum;
}

}  // namespace

std::uint32_t pass_samples(const PassLength& length, std::uint32_t taken, std::size_t pixels, double paths_per_second) {
  const double per_second = std::max(paths_per_second, 0.0) / static_cast<double>(std::max<std::size_t>(pixels, 1));
  double maximum = length.maximum;
  if (std::isfinite(length.seconds)) maximum = std::clamp(per_second * length.seconds, 1.0, maximum);
  const double wish = std::max(length.growth * taken, per_second * length.min_seconds);
  return std::max(static_cast<std::uint32_t>(std::min(wish, maximum)), 1u);
}

/// The interrupted pass goes on, if there is one.
void Progression::start_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit) {
  Schedule& s = schedule_;
  if (s.pass) return;
  const int step = next_step(engine);
  s.coarse = step > 1 ? step : 0;
  if (s.level_to == 0 && s.taken > 0) s.pass = refining_pass(engine, limit);
  s.refining = s.pass != nullptr;
  if (s.refining) return;
  s.end = std::max(s.level_to, 1u);
  Tiling tiling = tiling_for(engine);
  if (s.level_to > 0) {
    s.pass = pass_to(s.end, film_.region, tiling);
  } else if (s.coarse > 0) {
    tiling.reuses_paths = false;
    s.pass = std::make_unique<Pass>(film_.region, film_.first_sample, film_.first_sample + 1, s.coarse, s.coarse_done,
                                    tiling);
  } else {
    s.pass = full_pass(engine, limit);
  }
}

/// Step of the next pass: above 1, it is a coarse one.
int Progression::next_step(const RenderEngine& engine) const {
  if (schedule_.level_to > 0 || taken() > 0) return 1;
  if (schedule_.coarse_done == 0) return options_.coarse_step;
  const auto pixels = static_cast<std::int64_t>(film_.pixels.size());
  return engine.samples && is_slow_source(pixels, tally_.last_paths_per_second) ? schedule_.coarse_done / 2 : 1;
}

/// Tiles of passes. A source of samples may be slow: its tile jobs have as many paths as take about 2 ms.
Tiling Progression::tiling_for(const RenderEngine& engine) const {
  Tiling tiling{options_.tile, engine.scene.reuses_paths};
  if (!engine.samples) return tiling;
  tiling.paths = source_paths_per_tile(tally_.last_paths_per_second, engine.thread_pool.size());
  tiling.any_edge = true;
  return tiling;
}

/// Brings the pixels of a part to so many samples.
std::unique_ptr<Pass> Progression::pass_to(std::uint32_t samples, const Region& part, const Tiling& tiling) const {
  return std::make_unique<Pass>(film_, std::vector<std::uint32_t>(film_.pixels.size(), samples), part, tiling);
}

std::unique_ptr<Pass> Progression::full_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit) {
  Schedule& s = schedule_;
  const Tiling tiling = tiling_for(engine);
  s.end = s.taken + pass_samples(options_.length, s.taken, film_.pixels.size(), tally_.last_paths_per_second);
  if (limit) s.end = std::min(s.end, *limit);
  if (options_.adaptive) s.end = std::min(s.end, end_of_round(film_, s.taken, engine.thread_pool));
  if (planned_unevenly(film_)) return std::make_unique<Pass>(film_, counts_at(film_, s.end), film_.region, tiling);
  if (s.max > s.taken) return pass_to(s.end, film_.region, tiling);
  // The pixels of a coarse pass keep their first sample, unless it was taken without its group.
  const bool after_coarse = s.taken == 0 && s.coarse_done > 0;
  s.replaces = after_coarse && tiling.reuses_paths;
  if (s.replaces) film_.cut_throughput = {};
  const int skip_step = after_coarse && !s.replaces ? s.coarse_done : 0;
  return std::make_unique<Pass>(film_.region, film_.first_sample + s.taken, film_.first_sample + s.end, 1, skip_step,
                                tiling);
}

/// Null if no part is to be refined first, or if it has its samples.
std::unique_ptr<Pass> Progression::refining_pass(const RenderEngine& engine, std::optional<std::uint32_t> limit) {
  const Region part = part_of(film_, options_.first, engine.scene.reuses_paths);
  if (options_.adaptive || part.width() <= 0 || part.height() <= 0) return nullptr;
  const auto pixels = static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height());
  const std::uint32_t minimum = min_taken(film_, part);
  PassLength length = options_.length;
  length.maximum = 1024;  // a small part takes little time
  schedule_.end = minimum + pass_samples(length, minimum, pixels, tally_.last_paths_per_second);
  if (limit) schedule_.end = std::min(schedule_.end, *limit);
  return schedule_.end > minimum ? pass_to(schedule_.end, part, tiling_for(engine)) : nullptr;
}

void Progression::start(const RenderScene& scene, const Region& region, std::uint32_t first_sample,
                        const ProgressionOptions& options) {
  const auto pixels = static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
  const bool emission = needs_trait<&BsdfTraits::emits>(scene.features);
  const double quantum = options.quantum > 0 ? options.quantum : scene.film_quantum;
  if (film_.pixels.size() != pixels) {
    film_ = make_film(scene.width, scene.height, region, first_sample, quantum, emission);
  } else {  // the first pass replaces the pixels' contents
    if (options.clear) std::fill(film_.pixels.begin(), film_.pixels.end(), FilmPixel{});
    film_.emission.resize(emission ? pixels : 0);
    film_.width = scene.width, film_.height = scene.height;
    film_.region = region;
    film_.first_sample = first_sample;
    film_.quantum = quantum;
    film_.cut_throughput = {};
    film_.planned.clear();
  }
  begin(options);
}

void Progression::go_on(Film film, const ProgressionOptions& options) {
  film_ = std::move(film);
  begin(options);
  const FilmTotals sum = totals(film_);
  tally_.samples = sum.samples, tally_.rejected = sum.rejected, tally_.truncated = sum.truncated;
  if (planned_unevenly(film_)) {  // the next pass gives each pixel what it lacks
    schedule_.taken = static_cast<std::uint32_t>(sum.samples / film_.pixels.size());
    return;
  }
  schedule_.taken = sum.min_taken;
  // No pass more than doubles the samples, except those that refine a part first.
  if (sum.max_taken > 4 * std::max(sum.min_taken, options.length.maximum))
    schedule_.max = sum.max_taken;
  else if (sum.max_taken > sum.min_taken)
    schedule_.level_to = sum.max_taken;
}

void Progression::begin(const ProgressionOptions& options) {
  options_ = options;
  schedule_ = {};
  tally_ = {};
  last_write_ = Clock::now();
  pass_seconds_ = 0;
  levels_.forget();
  estimate_ = {};
  estimate_of_ = 0;
  next_estimate_ = options.estimates.seconds;
}

void Progression::estimate_now(const RenderEngine& engine, const std::atomic<bool>& give_up) {
  if (taken() < 2) return;
  estimate_ = estimate_error(film_, engine, levels_, give_up);
  estimate_of_ = taken();
}

bool Progression::reached(const Limits& limits) const {
  if (limits.spp && taken() >= *limits.spp) return true;
  if (taken() == 0) return false;
  return tally_.seconds >= limits.seconds || (limits.error > 0 && error() <= limits.error);
}

bool Progression::run_pass(const RenderEngine& engine, const Limits& limits, const std::atomic<bool>& give_up,
                           const std::function<void()>& poll) {
  start_pass(engine, limits.spp);
  const Clock::time_point start = Clock::now();
  running_from_ = options_.count_breaks ? last_write_ : start;
  const bool whole = schedule_.pass->run(engine, film_, give_up, poll);
  last_write_ = Clock::now();
  pass_seconds_ += seconds_between(start, last_write_);
  tally_.seconds += seconds_between(*running_from_, last_write_);
  running_from_.reset();
  if (!whole) return false;
  finish_pass();
  if (!estimate_is_due(limits)) return true;
  estimate_now(engine, give_up);
  next_estimate_ = (1 + options_.estimates.growth) * tally_.seconds + options_.estimates.seconds;
  return true;
}

void Progression::finish_pass() {
  Schedule& s = schedule_;
  const Pass& pass = *s.pass;
  tally_.rays += pass.rays(), tally_.shadow_rays += pass.shadow_rays(), tally_.splits += pass.splits();
  if (s.replaces) tally_.samples = tally_.rejected = tally_.truncated = 0;
  tally_.samples += pass.paths(), tally_.rejected += pass.rejected(), tally_.truncated += pass.truncated();
  tally_.last_mrays_per_s = static_cast<double>(pass.rays()) / pass_seconds_ * 1e-6;
  tally_.last_paths_per_second = static_cast<double>(pass.paths()) / pass_seconds_;
  pass_seconds_ = 0;
  if (s.coarse > 0)
    s.coarse_done = s.coarse;
  else if (s.refining)
    s.max = std::max(s.max, s.end);
  else
    s.taken = s.end;
  s.level_to = 0;
  s.replaces = false;
  s.pass.reset();
}

bool Progression::estimate_is_due(const Limits& limits) const {
  if (taken() < 2) return false;
  if (limits.error > 0 || taken() < options_.estimates.each_below) return true;
  const bool ever = std::isfinite(options_.estimates.seconds);
  return ever && (tally_.seconds >= next_estimate_ || (limits.spp && taken() >= *limits.spp));
}

PassTally Progression::tally() const {
  PassTally all = tally_;
  if (const Pass* pass = schedule_.pass.get())
    all.rays += pass->rays(), all.shadow_rays += pass->shadow_rays(), all.splits += pass->splits();
  if (running_from_) all.seconds += seconds_between(*running_from_, Clock::now());
  return all;
}

double Progression::cut_throughput() const {
  const Pass* pass = schedule_.pass.get();
  const std::uint64_t samples = (schedule_.replaces ? 0 : tally_.samples) + (pass ? pass->paths() : 0);
  return samples > 0 ? film_.cut_throughput.value() / static_cast<double>(samples) : 0;
}

}  // namespace tyndall

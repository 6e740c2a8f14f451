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

PassSchedule::PassSchedule(const ProgressionOptions& options, const Film& film) : options_(options) {
  const FilmTotals sum = totals(film);
  if (planned_unevenly(film)) {  // the next pass gives each pixel what it lacks
    taken_ = static_cast<std::uint32_t>(sum.samples / film.pixels.size());
    return;
  }
  taken_ = sum.min_taken;
  // No pass more than doubles the samples, except those that refine a part first.
  if (sum.max_taken > 4 * std::max(sum.min_taken, options.length.maximum))
    max_ = sum.max_taken;
  else if (sum.max_taken > sum.min_taken)
    level_to_ = sum.max_taken;
}

Pass& PassSchedule::next(Film& film, std::optional<std::uint32_t> limit, double paths_per_second,
                         const RenderEngine& engine) {
  if (pass_) return *pass_;
  const int step = next_step(film, paths_per_second, engine);
  coarse_ = step > 1 ? step : 0;
  if (level_to_ == 0 && taken_ > 0) pass_ = refining_pass(film, limit, paths_per_second, engine);
  refining_ = pass_ != nullptr;
  if (refining_) return *pass_;
  end_ = 1;
  if (level_to_ > 0) {
    end_ = level_to_;
    pass_ = std::make_unique<Pass>(film, std::vector<std::uint32_t>(film.pixels.size(), end_),
                                   tiling_for(engine, paths_per_second));
  } else if (coarse_ > 0) {
    Tiling tiling = tiling_for(engine, paths_per_second);
    tiling.reuses_paths = false;
    pass_ =
        std::make_unique<Pass>(film.region, film.first_sample, film.first_sample + 1, coarse_, coarse_done_, tiling);
  } else {
    pass_ = full_pass(film, limit, paths_per_second, engine);
  }
  return *pass_;
}

/// Step of the next pass: above 1, it is a coarse one.
int PassSchedule::next_step(const Film& film, double paths_per_second, const RenderEngine& engine) const {
  if (level_to_ > 0 || taken_ > 0) return 1;
  if (coarse_done_ == 0) return options_.coarse_step;
  const auto pixels = static_cast<std::int64_t>(film.pixels.size());
  return engine.samples && is_slow_source(pixels, paths_per_second) ? coarse_done_ / 2 : 1;
}

/// Tiles of passes. A source of samples may be slow: its tile jobs have as many paths as take about 2 ms.
Tiling PassSchedule::tiling_for(const RenderEngine& engine, double paths_per_second) const {
  Tiling tiling{options_.tile, engine.scene.reuses_paths};
  if (!engine.samples) return tiling;
  tiling.paths = source_paths_per_tile(paths_per_second, engine.thread_pool.size());
  tiling.any_edge = true;
  return tiling;
}

std::unique_ptr<Pass> PassSchedule::full_pass(Film& film, std::optional<std::uint32_t> limit, double paths_per_second,
                                              const RenderEngine& engine) {
  const Tiling tiling = tiling_for(engine, paths_per_second);
  end_ = taken_ + pass_samples(options_.length, taken_, film.pixels.size(), paths_per_second);
  if (limit) end_ = std::min(end_, *limit);
  if (options_.adaptive) end_ = std::min(end_, end_of_round(film, taken_, &engine.thread_pool));
  if (planned_unevenly(film)) return std::make_unique<Pass>(film, counts_at(film, end_), tiling);
  if (max_ > taken_) return std::make_unique<Pass>(film, std::vector<std::uint32_t>(film.pixels.size(), end_), tiling);
  // The pixels of a coarse pass keep their first sample, unless it was taken without its group.
  const bool after_coarse = taken_ == 0 && coarse_done_ > 0;
  replaces_ = after_coarse && tiling.reuses_paths;
  if (replaces_) film.cut_throughput = {};
  const int skip_step = after_coarse && !replaces_ ? coarse_done_ : 0;
  return std::make_unique<Pass>(film.region, film.first_sample + taken_, film.first_sample + end_, 1, skip_step,
                                tiling);
}

std::unique_ptr<Pass> PassSchedule::refining_pass(const Film& film, std::optional<std::uint32_t> limit,
                                                  double paths_per_second, const RenderEngine& engine) {
  const Region part = part_of(film, options_.first, engine.scene.reuses_paths);
  if (options_.adaptive || part.width() <= 0 || part.height() <= 0) return nullptr;
  const auto pixels = static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height());
  const std::uint32_t minimum = min_taken(film, part);
  PassLength length = options_.length;
  length.maximum = 1024;  // a small part takes little time
  end_ = minimum + pass_samples(length, minimum, pixels, paths_per_second);
  if (limit) end_ = std::min(end_, *limit);
  if (end_ <= minimum) return nullptr;
  return std::make_unique<Pass>(film, std::vector<std::uint32_t>(film.pixels.size(), end_), part,
                                tiling_for(engine, paths_per_second));
}

void PassSchedule::finish() {
  if (coarse_ > 0)
    coarse_done_ = coarse_;
  else if (refining_)
    max_ = std::max(max_, end_);
  else
    taken_ = end_;
  level_to_ = 0;
  replaces_ = false;
  pass_.reset();
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
  begin(PassSchedule(options), options);
}

void Progression::go_on(Film film, const ProgressionOptions& options) {
  film_ = std::move(film);
  begin(PassSchedule(options, film_), options);
  const FilmTotals sum = totals(film_);
  tally_.samples = sum.samples, tally_.rejected = sum.rejected, tally_.truncated = sum.truncated;
}

void Progression::begin(PassSchedule schedule, const ProgressionOptions& options) {
  options_ = options;
  schedule_ = std::move(schedule);
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
  Pass& pass = schedule_.next(film_, limits.spp, tally_.last_paths_per_second, engine);
  const Clock::time_point start = Clock::now();
  running_from_ = options_.count_breaks ? last_write_ : start;
  const bool whole = pass.run(engine, film_, give_up, poll);
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
  const Pass& pass = *schedule_.pass();
  tally_.rays += pass.rays(), tally_.shadow_rays += pass.shadow_rays(), tally_.splits += pass.splits();
  if (schedule_.replaces()) tally_.samples = tally_.rejected = tally_.truncated = 0;
  tally_.samples += pass.paths(), tally_.rejected += pass.rejected(), tally_.truncated += pass.truncated();
  tally_.last_mrays_per_s = static_cast<double>(pass.rays()) / pass_seconds_ * 1e-6;
  tally_.last_paths_per_second = static_cast<double>(pass.paths()) / pass_seconds_;
  pass_seconds_ = 0;
  schedule_.finish();
}

bool Progression::estimate_is_due(const Limits& limits) const {
  if (taken() < 2) return false;
  if (limits.error > 0 || taken() < options_.estimates.each_below) return true;
  const bool ever = std::isfinite(options_.estimates.seconds);
  return ever && (tally_.seconds >= next_estimate_ || (limits.spp && taken() >= *limits.spp));
}

PassTally Progression::tally() const {
  PassTally all = tally_;
  if (const Pass* pass = schedule_.pass())
    all.rays += pass->rays(), all.shadow_rays += pass->shadow_rays(), all.splits += pass->splits();
  if (running_from_) all.seconds += seconds_between(*running_from_, Clock::now());
  return all;
}

double Progression::cut_throughput() const {
  const Pass* pass = schedule_.pass();
  const std::uint64_t samples = (schedule_.replaces() ? 0 : tally_.samples) + (pass ? pass->paths() : 0);
  return samples > 0 ? film_.cut_throughput.value() / static_cast<double>(samples) : 0;
}

}  // namespace tyndall

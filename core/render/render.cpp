#include "core/render/render.h"

#include "core/accuracy/error.h"
#include "core/render/level.h"
#include "core/render/pass.h"
#include "core/render/plan.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Samples of the next pass. They grow, so that a render which is interrupted has covered the whole image; where time
/// or error decide, they grow with what is there, so that a look between them costs little and comes in time.
std::uint32_t next_samples(const RenderOptions& options, std::uint32_t taken) {
  const bool looks = options.target_error > 0 || options.time_limit < std::numeric_limits<double>::infinity();
  const std::uint32_t wish = std::clamp(looks ? taken / 4 : taken, 1u, 32u);
  return options.spp ? std::min(wish, *options.spp - taken) : wish;
}

class BlockingRender {
 public:
  BlockingRender(const RenderScene& scene, const RenderOptions& options, const ProgressCallback& progress, Film film)
      : view_(scene), options_(options), progress_(progress) {
    const auto kernels = choose_kernels(options.isa);
    if (!kernels) throw std::invalid_argument("no kernel for instruction set \"" + options.isa + "\"");
    kernels_ = *kernels;
    const Region region = options.region.value_or(Region{0, 0, scene.width, scene.height});
    result_.film = film.pixels.empty()
                       ? make_film(scene.width, scene.height, region, options.first_sample, scene.film_unit)
                       : std::move(film);
  }

  RenderResult run() {
    start_ = Clock::now();
    Crew crew(options_.threads);
    level_film(crew);
    while (!stop_ && !reached_limit()) {
      std::uint32_t count = next_samples(options_, taken_);
      Pass pass = next_pass(crew, count);
      pass.run(crew, kernels_, view_.view(), result_.film, stop_, [&] { report(pass, taken_); });
      result_.seconds = seconds_since(start_);
      result_.rays += pass.rays();
      result_.shadow_rays += pass.shadow_rays();
      if (stop_) break;
      taken_ += count;
      if (options_.target_error > 0) error_ = estimated_relative_error(result_.film, &crew);
      report_between(crew);
    }
    result_.threads = crew.size();
    result_.isa = kernels_.isa;
    result_.lanes = kernels_.lanes;
    result_.interrupted = stop_;
    result_.first_rejected = find_rejected(kernels_, view_.view(), result_.film);
    return std::move(result_);
  }

 private:
  /// count: samples a pixel, or their mean; made less where a round of adaptive sampling ends.
  Pass next_pass(Crew& crew, std::uint32_t& count) {
    Film& film = result_.film;
    if (options_.adaptive) count = std::min(count, end_of_round(film, taken_, &crew) - taken_);
    if (planned_unevenly(film)) return Pass(film, counts_at(film, taken_ + count), options_.tile);
    const std::uint32_t first = film.first_sample + taken_;
    return Pass(film.region, first, first + count, 1, 0, options_.tile);
  }
  /// A film that an interrupted pass left is made even before it is continued; where counts are to differ, the next
  /// pass does that.
  void level_film(Crew& crew) {
    if (planned_unevenly(result_.film)) {
      taken_ = static_cast<std::uint32_t>(totals(result_.film).samples / result_.film.pixels.size());
      return;
    }
    UnitCounts counts;
    level(crew, kernels_, view_.view(), result_.film, stop_, counts, [&] {
      if (progress_ && !progress_({taken_, seconds_since(start_), 0, error_})) stop_ = true;
    });
    result_.rays += counts.rays;
    result_.shadow_rays += counts.shadow_rays;
    result_.seconds = seconds_since(start_);
    taken_ = totals(result_.film).least_taken;
  }
  bool reached_limit() const {
    if (options_.spp && taken_ >= *options_.spp) return true;
    if (taken_ == 0) return false;
    return result_.seconds >= options_.time_limit || (options_.target_error > 0 && error_ <= options_.target_error);
  }
  void report(const Pass& pass, std::uint32_t spp) {
    if (!progress_) return;
    const double seconds = seconds_since(start_);
    const double rays = static_cast<double>(result_.rays + pass.rays());
    if (!progress_({spp, seconds, rays / seconds * 1e-6, error_})) stop_ = true;
  }
  /// The error is estimated now and then only: it reads the whole film.
  void report_between(Crew& crew) {
    if (!progress_) return;
    if (options_.target_error <= 0 && result_.seconds >= next_estimate_) {
      error_ = estimated_relative_error(result_.film, &crew);
      next_estimate_ = 1.5 * seconds_since(start_) + 0.5;
    }
    if (!progress_({taken_, result_.seconds, static_cast<double>(result_.rays) / result_.seconds * 1e-6, error_}))
      stop_ = true;
  }

  SceneViewOf view_;
  RenderOptions options_;
  const ProgressCallback& progress_;
  Kernels kernels_{};
  RenderResult result_;
  Clock::time_point start_;
  std::uint32_t taken_ = 0;
  double error_ = std::numeric_limits<double>::infinity(), next_estimate_ = 0.5;
  std::atomic<bool> stop_ = false;
};

}  // namespace

RenderResult render(const RenderScene& scene, const RenderOptions& options, const ProgressCallback& progress,
                    Film film) {
  return BlockingRender(scene, options, progress, std::move(film)).run();
}

}  // namespace tyndall

#include "app/cli/pictures.h"

#include "core/accuracy/estimate.h"
#include "core/base/seconds.h"
#include "core/render/clean_film.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr double shortest_interval = 0.25;  // seconds
constexpr double interval_over_cost = 200;  // of frames, and of clean views: together 1 %
constexpr double first_over_cost = 100;  // the first frame comes earlier: of a viewer that does not read it is the last
constexpr double seconds_per_pixel = 5e-8;        // of a frame, before the first one is measured
constexpr double clean_seconds_per_pixel = 2e-6;  // of one thread, before the first one is measured
constexpr double patience_over_elapsed = 0.005, shortest_patience = 0.02;

}  // namespace

LiveView::LiveView(const RenderJob& job)
    : job_(job), stream_(*job.command.viewer, job.loaded.name, job.loaded.scene.width, job.loaded.scene.height) {
  const double pixels = static_cast<double>(job.loaded.scene.width) * job.loaded.scene.height;
  cost_ = seconds_per_pixel * first_over_cost / interval_over_cost * pixels;
  clean_cost_ = clean_seconds_per_pixel * pixels / job.threads.count;
}

bool LiveView::due() const {
  return seconds_since(last_) >= std::max(shortest_interval, interval_over_cost * cost_) && stream_.ready();
}

void LiveView::take(const Film& film, ThreadPool& thread_pool) {
  const auto begin = Clock::now();
  if (totals(film).min_taken >= min_clean_spp && seconds_since(last_clean_) >= interval_over_cost * clean_cost_) {
    filter(film);
    clean_cost_ = seconds_since(begin), last_clean_ = Clock::now();
  }
  const auto after_clean = Clock::now();
  send(film, thread_pool);
  cost_ = seconds_since(after_clean), last_ = Clock::now();
}

void LiveView::filter(const Film& film) {
  clean_ = clean_film(film, *job_.prepared, job_.threads.count, job_.kernels.isa).rgb;
}

void LiveView::send(const Film& film, ThreadPool& thread_pool) {
  const std::vector<float> rgb = resolve(film), errors = pixel_relative_error(film, &thread_pool);
  ViewerFrame frame{film.region, {}};
  frame.values.reserve(viewer_channel_count * film.pixels.size());
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    frame.values.insert(frame.values.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], errors[i]});
    for (std::size_t c = 0; c < 3; ++c) frame.values.push_back(clean_.empty() ? 0.0f : clean_[3 * i + c]);
  }
  stream_.send(std::move(frame));
}

void LiveView::finish(const Film& film, const CleanPicture* clean) {
  const double patience = std::max(shortest_patience, patience_over_elapsed * seconds_since(start_));
  stream_.finish(patience);
  if (!stream_.ready()) return;
  if (clean)
    clean_ = clean->rgb;
  else if (totals(film).min_taken >= min_clean_spp)
    filter(film);
  ThreadPool thread_pool(job_.threads.count);
  send(film, thread_pool);
  stream_.finish(patience);
}

}  // namespace tyndall

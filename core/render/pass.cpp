#include "core/render/pass.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double unit_paths = 2048;
constexpr int least_tile = 8, most_tile = 64;  // most_tile² pixels are most_unit_pixels of a kernel

/// Edge for units of about unit_paths paths; a multiple of 8, so that coarse grids line up.
int chosen_tile(std::uint32_t samples, int step) {
  const double pixels = unit_paths * step * step / std::max(1u, samples);
  return std::clamp(static_cast<int>(std::sqrt(pixels)) / 8 * 8, least_tile, most_tile);
}

/// A worker's buffer, made once: nothing is allocated within a pass after its first unit.
std::vector<FilmPixel>& buffer() {
  thread_local std::vector<FilmPixel> pixels;
  return pixels;
}

}  // namespace

Pass::Pass(Region region, std::uint32_t first, std::uint32_t last, int step, int skip_step, int tile)
    : region_(region),
      first_(first),
      last_(last),
      step_(step),
      skip_step_(skip_step),
      tile_(tile > 0 ? std::min(tile, most_tile) : chosen_tile(last - first, step)),
      columns_((region.width() + tile_ - 1) / tile_),
      rows_((region.height() + tile_ - 1) / tile_),
      done_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

Region Pass::tile(int unit) const {
  const int x = region_.x0 + unit % columns_ * tile_, y = region_.y0 + unit / columns_ * tile_;
  return {x, y, std::min(x + tile_, region_.x1), std::min(y + tile_, region_.y1)};
}

bool Pass::run(Crew& crew, const Kernels& kernels, const SceneView& scene, Film& film, const std::atomic<bool>& give_up,
               const std::function<void()>& poll) {
  const auto job = [&](int unit) {
    auto& done = done_[static_cast<std::size_t>(unit)];
    if (done || give_up.load(std::memory_order_relaxed)) return;
    run_unit(unit, kernels, scene, film);
    done = 1;
  };
  crew.for_each(columns_ * rows_, job, poll);
  film.cut_throughput.add(ExactSum{cut_high_.exchange(0), cut_low_.exchange(0)});
  return std::all_of(done_.begin(), done_.end(), [](std::uint8_t d) { return d != 0; });
}

void Pass::run_unit(int unit, const Kernels& kernels, const SceneView& scene, Film& film) {
  const Region where = tile(unit);
  auto& pixels = buffer();
  pixels.assign(static_cast<std::size_t>(where.width()) * static_cast<std::size_t>(where.height()), {});
  UnitCounts counts;
  kernels.render_unit(scene, {where, step_, skip_step_, first_, last_}, film.unit, pixels.data(), counts);
  const bool first = first_ == film.first_sample;
  std::uint64_t paths = 0, rejected = 0, truncated = 0;
  auto from = pixels.begin();
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x, ++from) {
      if (!from->taken) continue;
      paths += from->taken;
      rejected += from->rejected[0] + from->rejected[1];
      truncated += from->truncated;
      if (first)
        film.at(x, y) = *from;
      else
        add_pixel(film.at(x, y), *from);
    }
  rays_.fetch_add(counts.rays, std::memory_order_relaxed);
  shadow_rays_.fetch_add(counts.shadow_rays, std::memory_order_relaxed);
  paths_.fetch_add(paths, std::memory_order_relaxed);
  rejected_.fetch_add(rejected, std::memory_order_relaxed);
  truncated_.fetch_add(truncated, std::memory_order_relaxed);
  cut_high_.fetch_add(counts.cut_throughput.high, std::memory_order_relaxed);
  cut_low_.fetch_add(counts.cut_throughput.low, std::memory_order_relaxed);
}

}  // namespace tyndall

#include "core/render/sample_source.h"

#include "core/base/random.h"

#include <algorithm>

namespace tyndall {
namespace {

Vec3f sample_at(const SampleSource& source, const SceneView& scene, int x, int y, std::uint32_t index) {
  const auto sampler = Sampler<float>::of(scene.seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                          index, scene.sampler);
  const Pair<float> in_pixel = sampler.next_2d(dimension::pixel);
  return source.sample(x + static_cast<double>(in_pixel.x), y + static_cast<double>(in_pixel.y), index);
}

}  // namespace

bool sample_tile(const SampleSource& source, const SceneView& scene, const TileJob& job, double film_quantum,
                 FilmPixel* pixels, const std::atomic<bool>& give_up) {
  for (int y = job.tile.y0; y < job.tile.y1; ++y)
    for (int x = job.tile.x0; x < job.tile.x1; ++x) {
      if (x % job.step != 0 || y % job.step != 0) continue;
      if (job.skip_step > 0 && x % job.skip_step == 0 && y % job.skip_step == 0) continue;
      const int place = (y - job.tile.y0) * job.tile.width() + x - job.tile.x0;
      FilmPixel& pixel = pixels[place];
      const std::uint32_t first = job.first_of ? job.first_of[place] : job.first;
      const std::uint32_t last = job.last_of ? job.last_of[place] : job.last;
      for (std::uint32_t index = first; index < last; ++index, ++pixel.taken) {
        if (give_up.load(std::memory_order_relaxed)) return false;
        add_sample(pixel, index & 1u, sample_at(source, scene, x, y, index), 1 / film_quantum);
      }
    }
  return true;
}

double source_paths_per_tile(double paths_per_second, int threads) {
  constexpr double seconds = 0.002, at_first = 16, maximum = 2048;
  if (paths_per_second <= 0) return at_first;
  return std::clamp(seconds * paths_per_second / std::max(threads, 1), 1.0, maximum);
}

int source_coarse_step(std::int64_t pixels, double paths_per_second, double seconds) {
  constexpr int maximum = 64;
  int step = 1;
  while (step<maximum&& static_cast<double>(pixels)> paths_per_second * seconds * step * step) step *= 2;
  return step;
}

bool is_slow_source(std::int64_t pixels, double paths_per_second) {
  constexpr double seconds = 0.5;
  return static_cast<double>(pixels) > paths_per_second * seconds;
}

}  // namespace tyndall

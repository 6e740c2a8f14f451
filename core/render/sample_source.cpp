#include "core/render/sample_source.h"

#include "core/base/random.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Where the samples of a pixel lie in it: as Sampler says, but what the samples of a half have in common is computed
/// once.
class PixelPoints {
 public:
  PixelPoints(const SceneView& scene, int x, int y)
      : scene_(scene),
        x_(static_cast<std::uint32_t>(x)),
        y_(static_cast<std::uint32_t>(y)),
        halves_{sampler_of(0), sampler_of(1)} {}

  Pair<float> of(std::uint32_t index) const {
    if (scene_.sampler != SamplerKind::sobol) return sampler_of(index).next_2d(dimension::pixel);
    Sampler<float> sampler = halves_[index & 1u];
    sampler.high = reverse_bits(index >> 1);
    return sampler.next_2d(dimension::pixel);
  }

 private:
  Sampler<float> sampler_of(std::uint32_t index) const {
    return Sampler<float>::of(scene_.seed, x_, y_, index, scene_.sampler);
  }

  const SceneView& scene_;
  std::uint32_t x_, y_;
  Sampler<float> halves_[2];
};

/// Adds a sample as add_sample() does. That computes in groups of four, which takes longer without wide instructions.
void add(FilmPixel& pixel, std::uint32_t half, Vec3f radiance, double per_quantum) {
  const ScaledSample sample = scaled(radiance, per_quantum);
  if (!sample.fits()) {
    ++pixel.rejected[half];
    return;
  }
  ExactSum* sum = pixel.sum[half];
  sum[0].add(sample.x), sum[1].add(sample.y), sum[2].add(sample.z);
}

/// Calls visit(pixel's place in the tile, index of the sample, its point) until it returns false; returns whether it
/// never did.
template <class Visit>
bool for_each_sample(const SceneView& scene, const TileJob& job, const Visit& visit) {
  for (int y = job.tile.y0; y < job.tile.y1; ++y)
    for (int x = job.tile.x0; x < job.tile.x1; ++x) {
      if (x % job.step != 0 || y % job.step != 0) continue;
      if (job.skip_step > 0 && x % job.skip_step == 0 && y % job.skip_step == 0) continue;
      const int place = (y - job.tile.y0) * job.tile.width() + x - job.tile.x0;
      const std::uint32_t last = job.last_of ? job.last_of[place] : job.last;
      const PixelPoints points(scene, x, y);
      for (std::uint32_t index = job.first_of ? job.first_of[place] : job.first; index < last; ++index) {
        const Pair<float> at = points.of(index);
        if (!visit(place, index, Pair<double>{x + static_cast<double>(at.x), y + static_cast<double>(at.y)}))
          return false;
      }
    }
  return true;
}

}  // namespace

bool sample_tile(const SampleSource& source, const SceneView& scene, const TileJob& job, double film_quantum,
                 FilmPixel* pixels, const std::atomic<bool>* leave) {
  if (source.announce) {
    std::vector<Pair<double>> points;
    for_each_sample(scene, job, [&](int, std::uint32_t, Pair<double> at) { return points.push_back(at), true; });
    source.announce(points);
  }
  const double per_quantum = 1 / film_quantum;
  return for_each_sample(scene, job, [&](int place, std::uint32_t index, Pair<double> at) {
    if (leave && leave->load(std::memory_order_relaxed)) return false;
    add(pixels[place], index & 1u, source.sample(at.x, at.y, index), per_quantum);
    return ++pixels[place].taken, true;
  });
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

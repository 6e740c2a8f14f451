#pragma once
#include "core/base/vec.h"
#include "core/trace/tile_job.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

/// Pictures whose samples come from a caller's function. Film, halves, passes, estimate and frames are those of any
/// picture; only the kernels are not asked.
namespace tyndall {

/// Where samples come from in place of the kernels.
struct SampleSource {
  /// Linear radiance at a point of the picture: x, y in pixels from the upper left corner, y down. index: of the sample
  /// among those of its pixel, from 0 on. Called by all rendering threads at once. May take long: see sample_tile().
  std::function<Vec3f(double x, double y, std::uint64_t index)> sample;
  /// Called with all points of a tile job before they are sampled, in their order, by the thread that samples them. So
  /// a source that is far away is asked once for all of them. Throws nothing. May be empty.
  std::function<void(const std::vector<Pair<double>>& points)> announce{};
};

/// Quantum of the films of sources, whose brightest sample nobody knows beforehand (see Film and ExactSum). Samples up
/// to 7e13 are counted, and 2^24 of a pixel add up as long as their mean is below 6e7. Smaller bits than 3e-14 are cut
/// off.
inline constexpr double source_quantum = 0x1p16;

/// Takes the samples of a tile job from the source, as Kernels::render_tile does from a scene, and adds them to
/// `pixels`. The points are those through which kernels send their rays; scene: whose seed and sampler choose them.
/// Looks at `leave` before each sample, unless it is null. Returns whether all samples were taken; if not, `pixels` are
/// of no use.
bool sample_tile(const SampleSource& source, const SceneView& scene, const TileJob& job, double film_quantum,
                 FilmPixel* pixels, const std::atomic<bool>* leave);

/// Paths of a tile job so that it takes about 2 ms, at least 1. paths_per_second: of all threads; 0: not known yet.
double source_paths_per_tile(double paths_per_second, int threads);

/// Step of the first coarse pass of `pixels` pixels (see ProgressionOptions) so that it takes about `seconds`: a power
/// of two up to 64. paths_per_second: 0: not known yet, then it is 64.
int source_coarse_step(std::int64_t pixels, double paths_per_second, double seconds);

/// Whether to sample all pixels takes more than half a second: then further coarse passes follow the first, each with
/// half its step, and pixels are shown as they come.
bool is_slow_source(std::int64_t pixels, double paths_per_second);

}  // namespace tyndall

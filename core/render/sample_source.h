#pragma once
#include "core/base/vec.h"
#include "core/trace/tile_job.h"

#include <cstdint>
#include <functional>

/// Pictures whose samples come from a caller's function. Film, halves, passes, estimate and frames are those of any
/// picture; only the kernels are not asked.
namespace tyndall {

/// Where samples come from in place of the kernels.
struct SampleSource {
  /// Linear radiance at a point of the picture: x, y in pixels from the upper left corner, y down. index: of the sample
  /// among those of its pixel, from 0 on. Called by all rendering threads at once.
  std::function<Vec3f(double x, double y, std::uint64_t index)> sample;
};

/// Takes the samples of a tile job from the source, as Kernels::render_tile does from a scene, and adds them to
/// `pixels`. The points are those through which kernels send their rays; scene: whose seed and sampler choose them.
void sample_tile(const SampleSource& source, const SceneView& scene, const TileJob& job, double film_quantum,
                 FilmPixel* pixels);

}  // namespace tyndall

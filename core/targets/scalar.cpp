// One path at a time, for any processor: the readable reference, and the kernel that records paths and probes scenes.
#include "core/targets/scalar.h"
#include "core/targets/entry.h"
#include "core/targets/recorder.h"

namespace tyndall {
namespace {

/// The one sample of a pixel, which is in the given half.
Vec3f sample_of(const FilmPixel& pixel, std::uint32_t half) {
  const float lost = pixel.rejected[half] ? __builtin_nanf("") : 0.0f;
  const auto value = [&](int c) { return lost + static_cast<float>(pixel.sum[half][c].value()); };
  return {value(0), value(1), value(2)};
}

/// Renders a tile job of one sample of one pixel, and records the sample's path.
void record_tile(const SceneView& s, const TileJob& job, const TileFilm& film, PathRecorder& recorder) {
  MaybeRecorder maybe{&recorder};
  render_either_tile<float>(s, job, film, maybe, [&](GroupSamples& groups) { recorder.reused = &groups.reused(); });
}

}  // namespace

Kernels scalar_kernels() { return full_kernel_of<float, MaybeRecorder>("scalar"); }

PathReplay replay(const SceneView& scene, int x, int y, std::uint32_t sample) {
  FilmPixel pixel{};
  TileCounts counts;
  PathRecorder recorder;
  record_tile(scene, {{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1}, {1, &pixel, nullptr, counts}, recorder);
  PathReplay path = recorder.path();
  if (scene.reuses_paths) path.radiance = sample_of(pixel, sample & 1u);
  return path;
}

void trace_groups(const SceneView& scene, ReusedPaths& paths, TileCounts& counts) {
  const TileFilm film{1, nullptr, nullptr, counts};
  GroupSamples samples(paths, {nullptr, nullptr}, film);
  MaybeRecorder none;
  follow_either<float>(scene, {}, film, &samples, none);
  add_specular_paths_to_leaving(scene, paths);
}

}  // namespace tyndall

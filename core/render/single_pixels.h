#pragma once
#include "core/accuracy/estimate.h"
#include "core/render/pass.h"

#include <atomic>
#include <cstddef>
#include <unordered_map>
#include <vector>

/// Extra samples of single pixels, apart from the film: they give the pixels' levels, for estimates of the film's error
/// (see ask_levels()), and name samples that had to be rejected.
namespace tyndall {

/// Levels of pixels from samples of their own, remembered until the scene changes. A level is a pure function of the
/// scene and the pixel, so that neither threads nor earlier calls change an estimate.
class PixelLevels {
 public:
  static constexpr std::uint32_t samples = 4096;  ///< of a level: some milliseconds of one thread

  /// To be called when the scene changes.
  void forget() { known_.clear(); }
  /// The levels of these pixels of the film; empty if `give_up` was set meanwhile, which it notices within 2 ms.
  std::vector<Vec3f> of(const std::vector<std::size_t>& pixels, const Film& film, const RenderEngine& engine,
                        const std::atomic<bool>& give_up);

 private:
  std::unordered_map<std::size_t, Vec3f> known_;  ///< by index of the pixel in the film
};

/// Asks `levels` for those of a film's pixels. What is returned refers to all four arguments. Empty where samples come
/// from a caller's function, which may be slow: thousands more of each of some pixels are not asked of it.
LevelsOf levels_of(const Film& film, const RenderEngine& engine, PixelLevels& levels, const std::atomic<bool>& give_up);

/// The pixels of the film with subpixel lights (trace/subpixel_lights.h), as ascending indices. None if there are more
/// than 32: then their errors average out, and their levels would take long to compute.
std::vector<std::size_t> pixels_with_subpixel_lights(const SceneView& scene, const Film& film);

/// The error of a film, with levels of the pixels that decide it, and of pixels with subpixel lights.
ErrorEstimate estimate_error(const Film& film, const RenderEngine& engine, PixelLevels& levels,
                             const std::atomic<bool>& give_up);

/// A sample that a film rejected because it was not finite or out of range. In full-image coordinates.
struct RejectedSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  bool operator==(const RejectedSample&) const = default;
};

/// The first `maximum` of a film's rejected samples, ordered by row, pixel and index. A film only counts them, so its
/// pixels with rejected samples are sampled once more, by the kernels that made the film: this needs no memory while
/// rendering, and the result does not depend on the order in which threads met them.
std::vector<RejectedSample> find_rejected(const Kernels& kernels, const SceneView& scene, const Film& film,
                                          std::size_t maximum = 4);

}  // namespace tyndall

#pragma once
#include "core/accuracy/estimate.h"
#include "core/render/pass.h"

#include <atomic>
#include <unordered_map>
#include <vector>

/// The levels of single pixels, for estimates of a film's error (see LevelsOf).
namespace tyndall {

/// Levels of pixels from samples of their own, remembered as long as the scene stays the same. A level is a pure
/// function of the scene and the pixel: so neither threads nor earlier questions change an estimate.
class PixelLevels {
 public:
  static constexpr std::uint32_t samples = 4096;  ///< of a level: some milliseconds of one thread

  /// To be called for another scene.
  void forget() { known_.clear(); }
  /// The levels of these pixels of the film; nothing if `give_up` was set meanwhile, which it notices within 2 ms.
  std::vector<Vec3f> of(const std::vector<std::size_t>& pixels, const Film& film, const RenderEngine& engine,
                        const std::atomic<bool>& give_up);

 private:
  bool find(const std::vector<std::size_t>& pixels, const Film& film, const RenderEngine& engine,
            const std::atomic<bool>& give_up);

  std::unordered_map<std::size_t, Vec3f> known_;  ///< by their places in the film
};

/// The error of a film, with levels of the pixels that decide it.
ErrorEstimate estimate_error(const Film& film, const RenderEngine& engine, PixelLevels& levels,
                             const std::atomic<bool>& give_up);

}  // namespace tyndall

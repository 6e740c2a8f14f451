#pragma once
#include "core/film/film.h"
#include "core/render/frame.h"
#include "core/render/sample_source.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace tyndall {

/// All that a caller wants of a Renderer, as one value: a newer request replaces it whole.
struct RenderRequest {
  std::shared_ptr<const Scene> scene{};  ///< null: no more is rendered; what was, stays
  /// Earlier samples of this scene, by the same version and instruction set: the picture continues them, and the film
  /// is moved from. Null: none; a film that is not of the scene's size counts as none.
  std::shared_ptr<Film> film{};
  /// Where the picture's samples come from; null: the kernels take them from the scene. With a source, what the scene
  /// has to say is the size, the number of samples, seed and sampler; best it has no objects. When what the source
  /// returns has changed, `restarts` has to.
  std::shared_ptr<const SampleSource> samples{};
  View view = View::beauty;
  bool clean = false;             ///< frames carry a clean view
  int threads = 0;                ///< number of threads; 0: as many as before
  bool paused = false;            ///< no pixel gets more than one sample; the current pass is completed
  std::uint64_t restarts = 0;     ///< another number than before discards the samples
  std::int64_t shown_pixels = 0;  ///< screen pixels that the picture covers: a first picture samples no more; <= 0: all
  /// This part of the picture gets all further samples once each pixel has one, until it has the scene's number of
  /// samples; then the rest follows. The samples of a pixel never change, so that the final picture is the same. No
  /// effect with adaptive sampling. Empty: none.
  Region refine_first{};
  std::optional<std::pair<int, int>> watched_pixel{};  ///< is reported now and after each pass

  bool operator==(const RenderRequest&) const = default;
};

}  // namespace tyndall

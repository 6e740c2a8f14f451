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

/// All that a caller wants of a Renderer, as one value: a newer one replaces it whole.
struct RenderRequest {
  std::shared_ptr<const Scene> scene{};  ///< null: none yet
  /// Samples of this scene that were taken before, by the same version and instruction set: the picture goes on from
  /// them, and the film is used up. Null: none; one that is not of the scene's size counts as none.
  std::shared_ptr<Film> film{};
  /// Where the picture's samples come from; null: the kernels take them from the scene. With a source, what the scene
  /// has to say is the size, the number of samples, seed and sampler; best it has no objects. When what the source
  /// returns has changed, `restarts` has to.
  std::shared_ptr<const SampleSource> samples{};
  View view = View::beauty;
  bool clean = false;             ///< frames carry a clean view
  int threads = 0;                ///< how many render; 0: as many as before
  bool paused = false;            ///< no pixel gets more than one sample; the pass that is under way ends
  std::uint64_t restarts = 0;     ///< another number than before: the samples are thrown away
  std::int64_t shown_pixels = 0;  ///< of a screen that the picture takes: a first picture samples no more; <= 0: all
  /// This part of the picture gets all further samples, as soon as each pixel has one, until it has as many as the
  /// scene asks for; then the rest follows. Which samples a pixel gets never changes, so that a picture is the same in
  /// the end. Of no effect with adaptive sampling. Empty: none.
  Region refine_first{};
  std::optional<std::pair<int, int>> watched_pixel{};  ///< is reported on now and after each pass

  bool operator==(const RenderRequest&) const = default;
};

}  // namespace tyndall

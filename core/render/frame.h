#pragma once
#include "core/base/choice.h"
#include "core/film/film.h"
#include "core/render/sample_source.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What is asked of a Renderer, and what it hands out after a pass.
namespace tyndall {

/// What a frame shows besides the beauty image.
enum class View { beauty, albedo, normal, depth, noise, samples, cost, object };

constexpr Label label(View view) {
  switch (view) {
    case View::beauty:
      return {"beauty"};
    case View::albedo:
      return {"albedo"};
    case View::normal:
      return {"normal"};
    case View::depth:
      return {"depth"};
    case View::noise:
      return {"noise"};
    case View::samples:
      return {"samples"};
    case View::cost:
      return {"cost", "rays of a path"};
    case View::object:
      return {"object", "what is seen first; a colour for each object"};
  }
  return {};
}

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

/// Positions of the pixels of a picture that has fewer pixels than its film: its pixel (x, y) shows the middle of the
/// film's pixel (spacing x, spacing y).
struct PictureGrid {
  int columns = 0, rows = 0;
  float spacing = 1;
};

/// The clean view of a picture: filtered, and labelled so wherever it is shown. Never changes after it was published.
struct CleanFrame {
  PictureGrid grid;                ///< of all members with a value for each pixel
  std::vector<float> rgba;         ///< like Frame's
  std::vector<float> pixel_error;  ///< estimated relative error of each pixel, from its neighbourhood
  double relative_error = 0;       ///< estimated; infinite for a coarse one
  std::uint32_t spp = 0;  ///< samples a pixel that it was made from; 0: it is coarse, see FilmCleaner::run_coarse
  bool doubtful = false;  ///< see is_doubtful
  double seconds = 0;     ///< rendering and filtering since the edit
};

/// What is known about one pixel of the beauty image, whatever view is shown.
struct PixelReport {
  int x = 0, y = 0;
  std::uint64_t edit = 0;      ///< of the picture
  std::uint32_t samples = 0;   ///< of this pixel; 0: nothing is known yet
  std::uint32_t rejected = 0;  ///< of these samples
  Vec3f mean{};                ///< linear radiance
  /// Standard error of the mean of each channel, from the differences of the two halves over the 7 x 7 pixels around:
  /// the difference of one pixel alone is too noisy. Infinite before two samples.
  Vec3f standard_error{};
};

/// One finished pass, ready to be shown. Never changes after it was published.
struct Frame {
  std::uint64_t edit = 0;  ///< number of the edit (Renderer::request) that the frame shows
  std::uint64_t pass = 0;  ///< counts up with every frame
  int width = 0, height = 0;
  /// 4 floats a pixel, linear, top row first: for every pixel, or for fewer after a coarse pass.
  std::vector<float> rgba;
  PictureGrid grid;  ///< of the pixels of `rgba`
  /// The beauty image in the same form while `view` is another one. Empty while `view` is beauty or only a coarse pass
  /// exists.
  std::vector<float> beauty;
  /// The newest clean view of the same picture, perhaps of fewer samples; null: none yet, or none is wanted. Shown
  /// instead of `rgba` while `view` is beauty; the noise view then shows its errors.
  std::shared_ptr<const CleanFrame> clean;
  bool awaits_clean = false;  ///< a newer clean view will come, even if no more samples are taken
  View view = View::beauty;
  int step = 1;           ///< every step-th pixel was rendered (8, 4, 2), 1: all
  std::uint32_t spp = 0;  ///< samples that every pixel has, with adaptive sampling their mean. The film is the one that
                          ///< render() makes for that number. 0 while only a coarse pass exists
  bool finished = false;  ///< the limit is reached, and the clean view (if wanted) is made from all samples
  double relative_error = 0;       ///< estimated; infinite before two samples
  bool rare_bright_paths = false;  ///< an estimate cannot be trusted: see has_rare_bright_paths, is_doubtful
  double seconds = 0;              ///< rendering time since the edit, pauses left out
  double mrays_per_s = 0;          ///< of the last pass
  double first_picture_ms = 0;     ///< from the edit or restart to the first frame after it
  std::uint64_t samples = 0, rejected = 0, truncated = 0;  ///< see PassTally
  double cut_throughput = 0;                               ///< see FilmTotals
  std::uint32_t max_spp = 0;  ///< samples of the part that was refined first; `spp` where there is none
  double white = 1;  ///< the value shown as white: relative error in the noise view, samples in that of samples, scene
                     ///< units in depth, rays a path in cost
  int guide_lobes = 0;        ///< of the scene's guide; 0: it has none
  double guide_ms = 0;        ///< that making the guide took, or finding out that none pays
  bool reuses_paths = false;  ///< groups of pixels reuse second vertices: see SceneView
  std::size_t film_bytes = 0;
  std::string isa;
  int lanes = 1, threads = 1;
};

/// An edit that cannot be shown, because its scene cannot be compiled. The scene before it stays on the screen.
struct RenderProblem {
  std::uint64_t edit = 0;
  std::string what;
};

/// All that a renderer reports.
struct RenderReply {
  std::shared_ptr<const Frame> frame;            ///< the newest one; null before the first
  std::shared_ptr<const RenderProblem> problem;  ///< of the newest edit if its scene cannot be compiled; else null
  std::shared_ptr<const PixelReport> pixel;      ///< the newest one, perhaps of the pixel watched before; null: none
};

}  // namespace tyndall

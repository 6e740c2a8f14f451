#pragma once
#include "app/window/document/document.h"
#include "core/image/image_io.h"
#include "core/render/renderer.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// References, which are pictures that are taken for the truth; and how far one picture is from another, as numbers and
/// as a picture of the differences.
namespace tyndall {

/// A picture that the window's own is measured against.
struct Reference {
  LinearImage image;
  double rel_mse = 0;                  ///< its own noise, the part of measured errors that is due to it; 0: not known
  std::string about;                   ///< "sky.exr", "this scene at 512 spp, seed 1"
  Scene scene;                         ///< what it shows: the scene in its file, else the one that it was loaded for
  bool known_method = false;           ///< the scene's method is that of the picture
  std::vector<std::string> remarks{};  ///< what the user should know of how its file was read
};

/// Reads a picture, and the scene and film that its file may hold. name: see PictureName; the film is not that of a
/// layer. document: what it is for. Throws as read_whole_picture() does, and UsageError for another size than the
/// document's picture has and for values that are not finite.
Reference read_reference(const std::filesystem::path& name, const Document& document);

/// Whether this is an image that holds no scene, or a layer of one.
bool shows_no_scene(const std::filesystem::path& name);
/// Whether it is of a kind that pictures of skies are of: HDR or EXR.
bool may_be_sky(const std::filesystem::path& name);

/// How a reference is rendered.
struct ReferenceOrder {
  Scene scene;            ///< with the picture's seed: another one is taken
  std::uint32_t spp = 1;  ///< samples a pixel
  int threads = 1;
  std::string isa;     ///< "": the best
  std::string name{};  ///< of the scene, where it is not the one on the screen; else ""
  Scene shown{};       ///< what is on the screen
};
/// Renders the scene with random numbers that are not those of the picture. progress: called now and then with the
/// samples so far; returns false to stop, then there is no result.
std::optional<Reference> rendered_reference(const ReferenceOrder& order,
                                            const std::function<bool(std::uint32_t spp)>& progress);

/// How a reference goes with a scene.
enum class ReferenceFit {
  fits,          ///< the same scene, perhaps rendered by another method: what differs is error
  same_samples,  ///< it fits, but has the same random numbers: noise looks too small
  other_scene,   ///< camera, objects, materials, ... differ
  other_size
};
ReferenceFit fit_of(const Reference& reference, const Scene& scene);

/// Linear RGB, 3 floats a pixel, of a frame's picture; empty where the frame has none (a view's coarse pass).
std::vector<float> picture_of(const Frame& frame);

/// The halves of a split view: on the right `current`, the scene as it is edited; on the left `kept`, the same scene
/// with the render settings that it had when the view was split. Without a split view all is `current`.
enum class Half { current, kept };

/// Pictures of differences, beside the views of the renderer.
enum class ErrorView { none, error, flip };

/// Two pictures of one size: a frame and what it is measured against.
struct ComparisonOrder {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const Frame> kept;  ///< the left half of a split view; null: the frame is compared with the reference
  std::shared_ptr<const Reference> reference;
  ErrorView map = ErrorView::none;
  bool flip = false;        ///< also FLIP
  bool clean = false;       ///< also the frame's clean view
  bool independent = true;  ///< of the reference's random numbers: its own noise is taken off, where that is known
};

struct ComparisonResult {
  double rel_mse = 0;                   ///< <= 0: less than the reference's own noise
  std::optional<double> clean_rel_mse;  ///< of the clean view, if that was asked for
  std::optional<double> flip;           ///< mean over the pixels, as `tyndall compare` prints it
  std::vector<float> map;               ///< 4 floats a pixel; empty: none was asked for
  double cpu_seconds = 0;               ///< what this took
};

/// Whether both pictures are there and have one size.
bool can_compare(const ComparisonOrder& order);

/// Takes milliseconds, with FLIP a second. The error map is grey: 1 is 100 % and more, as in the noise view; the FLIP
/// map has the colours of `tyndall compare --heatmap`.
ComparisonResult compare(const ComparisonOrder& order);

/// Limits work that comes again and again to a fraction of the processors' time: the more it took, the later it is due
/// again. Times are seconds of one clock.
struct ProcessorBudget {
  double fraction, next = 0;

  bool due(double now) const { return now >= next; }
  /// Work that began at the time `start` took `cpu_seconds` of one of `processors`.
  void spent(double start, double cpu_seconds, int processors) { next = start + cpu_seconds / (fraction * processors); }
  /// Makes the work due at once, because the user waits for it.
  void renew() { next = 0; }
};

}  // namespace tyndall

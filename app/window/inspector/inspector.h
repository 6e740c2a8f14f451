#pragma once
#include "app/report/replay.h"
#include "app/window/accuracy/views.h"
#include "app/window/document/job_queue.h"
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"
#include "app/window/rendering/renderer_pair.h"
#include "app/window/tools/pointer.h"
#include "core/film/film.h"
#include "core/render/frame.h"
#include "core/scene/scene.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// This room looks closer at the picture: at one pixel and at the path that makes it noisy, at what the colours of a
/// view mean, and at a rectangle that is refined first.
namespace tyndall {

/// What the inspector says.
struct PixelReadout {
  std::vector<std::string> lines;
  std::array<float, 3> shown{};  ///< the colour on the screen, in [0, 1]
};

/// frame: on the screen; report: on this pixel, or samples 0; seen: there, an object of the scene or none.
PixelReadout pixel_readout(const Frame& frame, const PixelReport& report, const Scene& scene,
                           const Renderer::Pick& seen);

/// What is told of a path: a sentence, then a line for each stop; of a long path the first ones and the last.
std::vector<std::string> path_lines(const NoisyPath& found, const std::vector<PathStop>& stops);

/// Where a point of the image is in the window. Those far outside, which would overflow the draw list's arithmetic, are
/// moved nearer.
ImVec2 in_window(const Rect& image, ImagePoint p);

/// A bar of colours with numbers beneath.
struct Legend {
  std::string title;                          ///< "" : the view needs none
  std::vector<std::array<float, 3>> colours;  ///< as the screen shows them, from left to right
  bool steps = false;                         ///< each colour fills its part of the bar; else they are blended
  std::vector<std::string> numbers;           ///< spread over the bar's length; of steps one in the middle of each
};

/// What the colours of a view mean. view: see view_entry(); white: see Frame.
Legend legend_of(int view, double white);

/// Draws it at the foot of the picture, on the right.
void draw_legend(Ui& ui, const Rect& visible, const Legend& legend);

/// Lets the user draw a rectangle over the picture.
class RectangleTool {
 public:
  /// Waits for a drag.
  void begin() { waits_ = true; }
  /// Nothing is drawn any more. Returns whether something was waited for or drawn.
  bool cancel();
  bool active() const { return waits_ || from_; }

  /// To be called in each drawing. free: nothing else has the mouse; width, height: of the picture, in pixels. Returns
  /// the rectangle when it was drawn; a click alone gives an empty one.
  std::optional<Region> update(const Mouse& mouse, const Rect& image, bool free, int width, int height);
  /// Draws the rectangle that is being drawn; else the one of that region, with a text above it.
  void draw(Ui& ui, const Rect& image, const Rect& visible, const Region& region, int width, int height,
            const std::string& text) const;

 private:
  bool waits_ = false;
  std::optional<ImagePoint> from_;
  ImagePoint to_;
};

/// What is known of the pixel under the cursor, and the path that makes it noisy.
class Inspector {
 public:
  /// wake: called from another thread when collect() has something to do.
  explicit Inspector(std::function<void()> wake) : jobs_(std::move(wake)) {}

  bool on() const { return on_; }
  void set_on(bool on);
  /// Finds the path of the pixel under the cursor in the background. scene: what is rendered.
  void find_path(const RendererPair& renderers, const std::shared_ptr<const Scene>& scene);
  /// Takes the path off the picture. Returns whether there was one.
  bool drop_path();

  /// The cursor is there; click: in the picture, nothing where it is beside.
  void point_at(std::optional<PictureClick> click) { at_ = click; }
  /// That pixel, while it is on: reports on it are wanted.
  std::optional<std::pair<int, int>> watched_pixel() const {
    return on_ && at_ ? std::optional(std::pair{at_->x, at_->y}) : std::nullopt;
  }
  /// Takes what was found in the background and the newest report. Whether there was anything.
  bool collect(const RendererPair& renderers);
  /// Whether something is being found.
  bool busy() const { return !jobs_.idle(); }

  /// Draws the path over the picture, and a box that tells of the pixel. scene: as it is edited.
  void draw(Ui& ui, const Context& context, const Scene& scene, const RendererPair& renderers);

 private:
  /// A path that was found, as it is drawn.
  struct Shown {
    std::shared_ptr<const Scene> scene;  ///< in which it was followed
    NoisyPath found;
    Vec3d eye;
    std::vector<PathStop> stops;
  };

  bool on_ = false;
  std::optional<PictureClick> at_;
  std::shared_ptr<const PixelReport> report_;
  std::shared_ptr<Shown> path_;
  std::uint64_t wanted_ = 0;  ///< number of the newest search
  JobQueue jobs_;             // last: its results use the others
};

}  // namespace tyndall

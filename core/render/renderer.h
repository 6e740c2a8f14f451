#pragma once
#include "core/base/vec.h"
#include "core/film/film.h"
#include "core/render/frame.h"
#include "core/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Interactive rendering: for the window.
namespace tyndall {

/// Renders progressively on its own threads: scenes go in (a newer one replaces one that is not begun yet), frames come
/// out. No call but film() waits for rendering. The picture of a scene does not depend on what was shown before it.
class Renderer {
 public:
  struct Options {
    int threads = 0;  ///< 0: see thread_count()
    std::string isa;  ///< "": the best
  };
  /// on_frame: called from a thread of the renderer after each frame; must be quick (e.g. wake an event loop).
  explicit Renderer(const Options& options, std::function<void()> on_frame = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Replaces the scene and returns the edit's number. A scene that renders to the same picture as the current one
  /// (equal but for names and display) restarts nothing and keeps the number of the current edit.
  std::uint64_t submit(Scene scene);
  /// The same for a scene that the caller goes on using: it is shared, not copied.
  /// film: samples of this scene that were taken before, by the same version and instruction set; the picture goes on
  /// from them, and the film is used up. Null: none; one that is not of the scene's size counts as none.
  std::uint64_t submit(std::shared_ptr<const Scene> scene, std::shared_ptr<Film> film = nullptr);
  /// The newest frame; null before the first.
  std::shared_ptr<const Frame> latest() const;
  /// What is wrong with the newest edit if its scene cannot be compiled; else null.
  std::shared_ptr<const RenderProblem> problem() const;

  void pause(bool paused);
  bool paused() const;
  /// Throws the samples away and starts over.
  void restart();
  void set_view(View view);
  /// Whether frames carry a clean view; off at first.
  void set_clean(bool clean);
  void set_threads(int threads);
  /// How many pixels of a screen the picture takes: a first picture does not sample more. <= 0: as many as it has.
  void set_shown_pixels(std::int64_t pixels);
  /// The frame of that pass is on the screen. Once this was called, the renderer gives way to the screen: after the
  /// first frame of an edit it goes on when that was shown, or after 50 ms.
  void note_shown(std::uint64_t pass);

  /// This part of the picture gets all further samples, as soon as each pixel has one, until it has as many as the
  /// scene asks for; then the rest follows. Which samples a pixel gets never changes, so that a picture is the same in
  /// the end. Of no effect with adaptive sampling. Empty: none.
  void refine_first(const Region& part);
  /// Reports on this pixel now and after each pass, on_frame is called then; nothing: reports on none.
  void watch_pixel(std::optional<std::pair<int, int>> pixel);
  /// The newest report, perhaps on the pixel that was watched before; null: none yet.
  std::shared_ptr<const PixelReport> pixel() const;

  /// A copy of the film, for example for snapshots. Waits for the end of the pass that is under way, so that all pixels
  /// have as many samples as they are to have. Empty before the first full pass.
  Film film() const;
  /// What is seen at a pixel of the newest compiled scene: the object as a path of indices into Scene::objects (one for
  /// each group that it is in; empty: nothing), its depth along the camera's axis, and the point, in world space.
  struct Pick {
    std::vector<int> object;
    double depth = 0;
    Vec3d point;
  };
  Pick pick(int x, int y) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall

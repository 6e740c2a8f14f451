#pragma once
#include "app/window/accuracy/fair_share.h"
#include "app/window/accuracy/half.h"
#include "core/render/clean_film.h"
#include "core/render/renderer.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>

/// The renderers behind the window: one, or two while the view is split.
namespace tyndall {

/// The window's renderer and, in a split view, a second one for the left half. The second one renders the same scene
/// with the settings that were kept, and both get the same processor time. For the main thread unless it says
/// otherwise; nothing here waits for rendering.
class RendererPair {
 public:
  /// threads: of both together, > 0. on_frame: called from a thread of a renderer after each frame.
  RendererPair(int threads, std::string isa, std::function<void()> on_frame);
  ~RendererPair();
  RendererPair(const RendererPair&) = delete;
  RendererPair& operator=(const RendererPair&) = delete;

  /// Which halves have begun another picture.
  struct Begun {
    bool current = false, kept = false;
  };
  /// Hands a scene to both. A scene with the same picture as the one before restarts nothing.
  /// film: samples of it that are there already, see Renderer; null: none.
  Begun submit(const std::shared_ptr<const Scene>& scene, std::shared_ptr<Film> film = nullptr);
  /// Throws away the samples of both renderers and starts over.
  void restart();

  /// Splits the view: the left half keeps the scene's settings, and the right one starts over.
  void begin_split(const Scene& scene);
  /// Ends the split view. Returns the second renderer. Destroying it can take as long as a unit of its work, so the
  /// caller should do that where nobody waits.
  std::shared_ptr<Renderer> end_split();
  bool split() const { return second_ != nullptr; }
  /// The scene that the left half of a split view renders, and its settings.
  Scene kept_scene(const Scene& scene) const;
  const RenderSettings& kept_settings() const { return kept_; }

  void pause(bool paused);
  bool paused() const { return paused_; }
  void set_threads(int threads);
  int threads() const { return threads_; }
  /// How many pixels of the screen a picture takes.
  void set_shown_pixels(std::int64_t pixels);
  /// A half's frame of that pass is on the screen, see Renderer.
  void note_shown(Half half, std::uint64_t pass);
  /// Of both halves, see Renderer.
  void refine_first(const Region& part);
  const Region& refined_first() const { return first_; }
  void set_view(View view);
  /// Whether frames carry a clean view.
  void set_clean(bool clean);
  bool clean() const { return clean_; }

  /// The newest frame; null: there is none.
  std::shared_ptr<const Frame> latest(Half half) const;
  /// Number of the newest edit that a half was given. That of the current half from any thread.
  std::uint64_t edit(Half half) const { return half == Half::kept ? kept_edit_ : edit_.load(); }
  /// Nothing renders: paused, or all pictures are finished.
  bool resting() const;
  /// Whether the newest pictures of all halves are finished, in the chosen view: no other frame comes by itself. A
  /// paused picture is not finished.
  bool finished() const;
  /// Of the current half, see Renderer; the film from any thread.
  Film film() const { return renderer_.film(); }
  Renderer::Pick pick(int x, int y) const { return renderer_.pick(x, y); }
  void watch_pixel(std::optional<std::pair<int, int>> pixel) { renderer_.watch_pixel(pixel); }
  std::shared_ptr<const PixelReport> pixel() const { return renderer_.pixel(); }
  std::shared_ptr<const RenderProblem> problem() const { return renderer_.problem(); }

 private:
  bool submit_kept(const Scene& scene);

  std::string isa_;
  std::function<void()> on_frame_;
  int threads_;
  bool paused_ = false, clean_ = false;
  std::int64_t shown_pixels_ = 0;
  Region first_;
  View view_ = View::beauty;
  std::atomic<std::uint64_t> edit_ = 0;
  RenderSettings kept_;  ///< of the left half
  std::uint64_t kept_edit_ = 0;
  std::uint64_t restarted_after_ = 0;  ///< the newest pass of the current half when it was last started over
  FairShare share_{renderer_};
  Renderer renderer_;
  std::shared_ptr<Renderer> second_;  ///< of the left half; null: there is no split view
};

}  // namespace tyndall

#pragma once
#include "core/kernel/kernels.h"
#include "core/scene/scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tyndall {

/// What a frame shows besides the beauty image.
enum class View { beauty, albedo, normal, depth, noise, samples, cost };

/// One finished pass, ready to be shown. Never changes after it was published.
struct Frame {
  std::uint64_t edit = 0;  ///< number of the edit (Renderer::submit) that it shows
  std::uint64_t pass = 0;  ///< counts up with every frame
  int width = 0, height = 0;
  std::vector<float> rgba;  ///< 4 floats a pixel, top row first, linear; holes of a coarse pass are filled
  std::vector<float>
      beauty;  ///< the same of the picture itself while `view` is another, without coarse passes; or empty
  View view = View::beauty;
  int step = 1;               ///< every step-th pixel was rendered (8, 4, 2), 1: all
  std::uint32_t spp = 0;      ///< samples that every pixel has, or with adaptive sampling their mean; the same film
                              ///< as render() makes for that number; 0 while only a coarse pass is there
  bool finished = false;      ///< the limit is reached
  double relative_error = 0;  ///< estimated; infinite before two samples
  bool rare_bright_paths = false;  ///< the estimate says too little: see has_rare_bright_paths
  double seconds = 0;              ///< rendering time since the edit, pauses left out
  double mrays_per_s = 0;          ///< of the last pass
  double first_picture_ms = 0;     ///< from submit() or restart() to the first frame after it
  std::uint64_t rejected = 0, truncated = 0;
  double cut_throughput = 0;  ///< see FilmTotals
  std::size_t film_bytes = 0;
  std::string isa;
  int lanes = 1, threads = 1;
};

/// An edit that cannot be shown (compile failed); the last good picture stays.
struct RenderProblem {
  std::uint64_t edit = 0;
  std::string what;
};

/// Renders progressively on its own threads: scenes go in through a mailbox (newest wins), frames come out. No call
/// waits for rendering. The picture of a scene does not depend on what was shown before it.
class Renderer {
 public:
  struct Options {
    int threads = 0;  ///< 0: all cores
    std::string isa;  ///< "": the best
  };
  /// on_frame: called from a thread of the renderer after each frame; must be quick (e.g. wake an event loop).
  explicit Renderer(Options options, std::function<void()> on_frame = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Replaces the scene and returns the edit's number. A scene that renders to the same picture as the current one
  /// (equal but for names and display) restarts nothing and keeps the number of the current edit.
  std::uint64_t submit(Scene scene);
  /// The newest frame; null before the first.
  std::shared_ptr<const Frame> latest() const;
  /// The newest problem, if the newest edit could not be compiled.
  std::shared_ptr<const RenderProblem> problem() const;

  void pause(bool paused);
  bool paused() const;
  /// Throws the samples away and starts over.
  void restart();
  void set_view(View view);
  void set_threads(int threads);

  /// A copy of the current film (for EXR snapshots), taken between passes; empty before the first full pass.
  Film film() const;
  /// Object under a pixel of the newest compiled scene: index path into Scene::objects (groups nest), empty for none;
  /// depth along the axis and distance to it.
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

#pragma once
#include "core/base/vec.h"
#include "core/render/render_request.h"

#include <functional>
#include <string>
#include <vector>

/// Interactive rendering, for the window.
namespace tyndall {

/// Renders progressively on its own threads: requests go in (the newest one counts), frames come out. No call but
/// film() waits for rendering. The picture of a scene does not depend on what was shown before.
class Renderer {
 public:
  struct Options {
    int threads = 0;  ///< 0: see thread_count()
    std::string isa;  ///< "": the best
  };
  /// on_frame: called from a thread of the renderer after each frame; must be quick (for example, wake an event loop).
  explicit Renderer(const Options& options, std::function<void()> on_frame = {});
  ~Renderer();

  /// Replaces the request, and returns the number of the edit that it shows. A scene that renders to the same picture
  /// as the one before (equal but for names and display) restarts nothing and keeps its number.
  std::uint64_t request(RenderRequest request);
  /// The results so far.
  RenderReply reply() const;
  std::shared_ptr<const Frame> latest() const { return reply().frame; }
  /// Reports that the frame of that pass is on the screen. After the first such call the renderer gives way to the
  /// screen: after the first frame of an edit it waits until that was shown, at most 50 ms.
  void note_shown(std::uint64_t pass);

  /// A copy of the film, for example for snapshots. Waits for the end of the current pass, so that all pixels have
  /// their full number of samples. Empty before the first full pass.
  Film film() const;
  /// The first hit at a pixel of the newest compiled scene: the object as a path of indices into Scene::objects (one
  /// for each group that it is in; empty: nothing), its depth along the camera's axis, and the point, in world space.
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

#pragma once
#include "core/compile/render_scene.h"
#include "core/reuse/probe.h"
#include "core/scene/scene.h"
#include "core/trace/scene_view.h"

#include <memory>
#include <mutex>
#include <vector>

/// The stage between compiling a scene and rendering it.
namespace tyndall {

/// All that is known about a scene before its first sample: its compiled columns, the subpixel lights that the camera
/// sees, whether second vertices are reused between pixels, and how likely paths are to meet caustics. It never
/// changes, and any number of threads can use it at once.
class PreparedScene {
 public:
  /// columns: compiled from `scene`. Except to measure changed columns, call prepare() instead.
  PreparedScene(std::shared_ptr<const Scene> scene, RenderScene columns);
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  const Scene& scene() const { return *scene_; }
  const RenderScene& columns() const { return columns_; }
  /// What kernels read; valid as long as this object.
  const SceneView& view() const { return view_; }
  /// Whether second vertices are reused between pixels: it is allowed, possible, and pays.
  bool reuses_paths() const { return view_.reuses_paths; }
  /// What reuse would gain; not probed where it is not allowed or not possible.
  const ReuseGain& reuse_gain() const { return reuse_gain_; }
  /// See chance_of_caustics(). Computed at the first call, as only pictures of many samples need it.
  double caustic_chance() const;

 private:
  std::shared_ptr<const Scene> scene_;
  RenderScene columns_;
  std::vector<TextureView> textures_;
  std::vector<SubpixelLight> subpixel_lights_;
  ReuseGain reuse_gain_;
  SceneView view_;
  mutable std::once_flag caustic_chance_found_;
  mutable double caustic_chance_ = 1;
};

/// Compiles a scene and computes all that is needed to render it: a pure function of the scene. before: a prepared
/// scene from which common parts, such as the tree, are taken over; null: none.
std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before = nullptr);
/// The same for a scene that is copied.
std::shared_ptr<const PreparedScene> prepare(const Scene& scene);

}  // namespace tyndall

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
  /// columns: compiled from `scene`. guide: of the scene; null: it is made here. Except to measure changed columns,
  /// call prepare() instead.
  PreparedScene(std::shared_ptr<const Scene> scene, const RenderScene& columns, const Guide* guide = nullptr);

  const Scene& scene() const { return *scene_; }
  const RenderScene& columns() const { return view_; }
  /// What kernels read.
  const SceneView& view() const { return view_; }
  /// Whether second vertices are reused between pixels: it is allowed, possible, and pays.
  bool reuses_paths() const { return view_.reuses_paths; }
  /// What reuse would gain; not probed where it is not allowed or not possible.
  const ReuseGain& reuse_gain() const { return reuse_gain_; }
  /// Directions from which light comes by way of several near-specular surfaces or off metal of little fuzz.
  const Guide& guide() const { return view_.guide; }
  /// Glass and polished metal throw light on other surfaces. Shadow rays do not find that light: unless specular paths
  /// or the guide do, a path has to hit the light by BSDF sampling, by way of the smooth shape. Returns the smallest
  /// probability of that, in (0, 1]: for each pair of a light and a smooth shape that catches at least a hundredth of
  /// its light, the fraction of all directions that the light fills as seen from the shape. 1 if there is no such pair,
  /// or no matt surface or medium that would show such light. With fewer than about 2 / chance samples a pixel, most
  /// pixels have not met such light at all. Then their halves agree on a wrong value: the estimated error is too small.
  /// - A light seen in metal with a little fuzz counts as larger, by the width of the metal's lobe. Shadow rays are
  /// sent from such metal, but a path from a wall reaches it by BSDF sampling only.
  /// - A light within a ball, such as a bulb, counts as seen from its surface, unless the camera is in the ball, too.
  /// - The light of a picture of the sky counts as one light as wide as its spread, see SkyDistribution.
  /// Computed at the first call, as only pictures of many samples need it.
  double caustic_chance() const;

 private:
  std::shared_ptr<const Scene> scene_;
  SceneView view_;
  ReuseGain reuse_gain_;
  mutable std::once_flag caustic_chance_found_;
  mutable double caustic_chance_ = 1;
};

/// Compiles a scene and computes all that is needed to render it: a pure function of the scene. before: a prepared
/// scene from which common parts, such as the tree, are taken over; null: none.
std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before = nullptr);
/// The same for a scene that is copied.
std::shared_ptr<const PreparedScene> prepare(const Scene& scene);
/// The same without splitting (transport/splitting.h), to measure what it gains.
std::shared_ptr<const PreparedScene> prepare_without_splitting(const Scene& scene);

}  // namespace tyndall

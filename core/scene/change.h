#pragma once
#include "core/scene/scene.h"

namespace tyndall {

/// Which parts of a scene an edit has changed, among those on which samples depend. The scene's name, its display
/// settings and the number of samples at which to stop are not among them.
struct SceneChange {
  bool camera = false;
  bool others = false;  ///< anything but the camera
  bool none() const { return !camera && !others; }
};
SceneChange change_between(const Scene& before, const Scene& after);

}  // namespace tyndall

#pragma once
#include "core/scene/scene.h"

#include <optional>
#include <set>

/// Flying through the scene with W, A, S, D, Q and E.
namespace tyndall {

/// A direction of flight: axis 0 right, 1 up, 2 forward; sign 1 or -1.
struct FlyKey {
  int axis = 0, sign = 0;
};
/// What a key does while it is held; nothing for all but W, A, S, D, Q, E. key: GLFW's number.
std::optional<FlyKey> fly_key(int key);

/// Flies the camera while keys are held.
class Flight {
 public:
  /// To be called in each drawing; changes the camera. held: keys, by GLFW's numbers; fast: four times as fast. Keys
  /// that are let go in the very next drawing have flown for `tap` seconds. Returns whether it flies: then the window
  /// is to be drawn again soon.
  bool update(const std::set<int>& held, bool fast, double now, Camera& camera);

 private:
  static constexpr double tap = 1 / 60.0;

  double last_ = -1;    ///< second of the last drawing in flight; < 0: it does not fly
  Vec3d heading_;       ///< where it flew to then: right, up, forward
  bool moved_ = false;  ///< the camera has moved in this flight
};

/// Whether a key of flight is among these.
bool holds_fly_key(const std::set<int>& held);

}  // namespace tyndall

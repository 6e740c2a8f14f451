#include "app/window/tools/flight.h"

#include "app/window/tools/camera_control.h"

#include <algorithm>

namespace tyndall {

std::optional<FlyKey> fly_key(int key) {
  switch (key) {
    case 'D':
      return FlyKey{0, 1};
    case 'A':
      return FlyKey{0, -1};
    case 'E':
      return FlyKey{1, 1};
    case 'Q':
      return FlyKey{1, -1};
    case 'W':
      return FlyKey{2, 1};
    case 'S':
      return FlyKey{2, -1};
    default:
      return {};
  }
}

bool holds_fly_key(const std::set<int>& held) {
  return std::any_of(held.begin(), held.end(), [](int key) { return fly_key(key).has_value(); });
}

bool Flight::update(const std::set<int>& held, bool fast, double now, Camera& camera) {
  Vec3d heading;
  double* const axes[3] = {&heading.x, &heading.y, &heading.z};
  for (const int key : held)
    if (const auto direction = fly_key(key)) *axes[direction->axis] += direction->sign;
  const bool flies = !(heading == Vec3d{}), tapped = !flies && last_ >= 0 && !moved_;
  const double seconds = tapped ? tap : flies && last_ >= 0 ? std::min(now - last_, 0.1) : 0;
  if (seconds > 0) {
    const double speed = (fast ? 3.0 : 0.75) * target_distance(camera);  // scene units a second
    const Vec3d step = seconds * speed * (tapped ? heading_ : heading);
    camera = fly(camera, step.x, step.y, step.z);
  }
  moved_ = flies && last_ >= 0;
  heading_ = heading;
  last_ = flies ? now : -1;
  return flies;
}

}  // namespace tyndall

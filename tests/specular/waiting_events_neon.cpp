#include "core/base/lanes_simd.h"
#include "tests/specular/waiting_events_in_lanes.h"

namespace tyndall::test {
void light_of_events_neon(const SceneView& scene, const WaitingEvent* events, int count, int together, Vec3f* light) {
  light_of_events<HWY_NAMESPACE::Floats>(scene, events, count, together, light);
}
}  // namespace tyndall::test

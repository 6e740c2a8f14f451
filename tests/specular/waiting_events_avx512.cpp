#include "core/base/lanes_twice.h"
#include "tests/specular/waiting_events_in_lanes.h"

namespace tyndall::test {
void light_of_events_avx512(const SceneView& scene, const WaitingEvent* events, int count, int together, Vec3f* light) {
  light_of_events<Twice<HWY_NAMESPACE::Floats>>(scene, events, count, together, light);
}
}  // namespace tyndall::test

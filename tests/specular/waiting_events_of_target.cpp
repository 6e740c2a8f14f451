// Compiled once for each wide instruction set of the build, see core/base/lanes_target.h.
#include "core/base/lanes_target.h"
#include "tests/specular/waiting_events_in_lanes.h"

namespace tyndall::test {
template <>
void light_of_events_for<Target::TYNDALL_TARGET>(const SceneView& scene, const WaitingEvent* events, int count,
                                                 int together, Vec3f* light) {
  light_of_events<KernelLanes>(scene, events, count, together, light);
}
}  // namespace tyndall::test

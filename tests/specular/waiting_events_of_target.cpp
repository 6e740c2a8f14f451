// Compiled once for each wide instruction set of the build, see core/base/lanes_target.h. Nothing of the standard
// library is used here: the linker could keep this file's copies of its templates for all others, and older processors
// cannot run them.
#include "core/base/lanes_target.h"
#include "core/transport/path.h"
#include "tests/specular/waiting_events.h"

namespace tyndall::test {
template <>
void light_of_events_for<Target::TYNDALL_TARGET>(const SceneView& scene, const WaitingEvent* events, int count,
                                                 int together, Vec3f* light) {
  WaitingRequests<KernelLanes> waiting{};
  SpecularQueue<KernelLanes>& queue = waiting.specular;
  TileCounts counts;
  const int room = together < lanes_of<KernelLanes> ? together : lanes_of<KernelLanes>;
  for (int first = 0; first < count; first += room) {
    queue.count = count - first < room ? count - first : room;
    for (int i = 0; i < queue.count; ++i) {
      const WaitingEvent& event = events[first + i];
      for (int k = 0; k < 11; ++k) queue.number[k][i] = event.number[k];
      for (int k = 0; k < 7; ++k) queue.integer[k][i] = event.ints[k];
      queue.integer[2][i] = first + i;  // the slot
    }
    answer_full_queues(scene, waiting, true, counts, [light](std::int32_t i, Vec3f found) { light[i] = found; });
  }
}
}  // namespace tyndall::test

#pragma once
#include "core/transport/path.h"
#include "tests/specular/waiting_events.h"

/// See LightOfEvents. Included by one file for each instruction set. Nothing of the standard library is used here: the
/// linker could keep these files' copies of its templates for all others, and older processors cannot run them.
namespace tyndall::test {
namespace {

template <class F>
void light_of_events(const SceneView& scene, const WaitingEvent* events, int count, int together, Vec3f* light) {
  SpecularQueue<F> queue{};
  TileCounts counts;
  const int room = together < lanes_of<F> ? together : lanes_of<F>;
  for (int first = 0; first < count; first += room) {
    queue.count = count - first < room ? count - first : room;
    for (int i = 0; i < queue.count; ++i) {
      const WaitingEvent& event = events[first + i];
      for (int k = 0; k < 11; ++k) queue.number[k][i] = event.number[k];
      for (int k = 0; k < 7; ++k) queue.integer[k][i] = event.ints[k];
      queue.integer[2][i] = first + i;  // the slot
    }
    answer_requests<F>(scene, queue, counts, [light](std::int32_t i, Vec3f found) { light[i] = found; });
  }
}

}  // namespace
}  // namespace tyndall::test

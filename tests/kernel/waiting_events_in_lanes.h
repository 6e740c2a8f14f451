#pragma once
#include "core/kernel/path.h"
#include "tests/kernel/waiting_events.h"

/// See LightOfEvents. Included by one file for each instruction set. Nothing of the standard library is used here: the
/// linker could keep these files' copies of its templates for all others, and older processors cannot run them.
namespace tyndall::test {
namespace {

template <class F>
void light_of_events(const SceneView& scene, const WaitingEvent* events, int count, int together, Vec3f* light) {
  using Queue = ChainQueue<F>;
  Queue queue{};
  UnitCounts counts;
  const int room = together < lanes_of<F> ? together : lanes_of<F>;
  for (int first = 0; first < count; first += room) {
    queue.count = count - first < room ? count - first : room;
    for (int i = 0; i < queue.count; ++i) {
      const WaitingEvent& event = events[first + i];
      for (int k = 0; k < Queue::numbers; ++k) queue.number[k][i] = event.number[k];
      for (int k = 0; k < Queue::words; ++k) queue.word[k][i] = event.ints[k];
      queue.word[2][i] = first + i;
    }
    find_waiting_chains(scene, queue, counts, [light](std::int32_t i, Vec3f found) { light[i] = found; });
  }
}

}  // namespace
}  // namespace tyndall::test

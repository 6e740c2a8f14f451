#pragma once
#include "core/base/target.h"
#include "core/base/vec.h"
#include "core/trace/scene_view.h"

#include <cstdint>

/// Events that wait for specular light paths (SpecularQueue in transport/specular_queue.h), given to the kernels by
/// hand. Compiled once for each instruction set, with its flags.
namespace tyndall::test {

struct WaitingEvent {
  float number[11];      ///< point, normal or direction, throughput, time and g: in the order of each_part()
  std::int32_t ints[7];  ///< Ray::from, depth, slot, the sampler's three numbers, and 1 for an event in a medium
};

/// Finds the light that specular paths bring to each of `count` events. They are taken in groups of `together` events,
/// or of as many as there are lanes if there are fewer.
using LightOfEvents = void (*)(const SceneView& scene, const WaitingEvent* events, int count, int together,
                               Vec3f* light);

/// The function of a wide target that this build has and this CPU can run.
template <Target>
void light_of_events_for(const SceneView& scene, const WaitingEvent* events, int count, int together, Vec3f* light);
template <>
void light_of_events_for<Target::sse4>(const SceneView& scene, const WaitingEvent* events, int count, int together,
                                       Vec3f* light);
template <>
void light_of_events_for<Target::avx2>(const SceneView& scene, const WaitingEvent* events, int count, int together,
                                       Vec3f* light);
template <>
void light_of_events_for<Target::avx512>(const SceneView& scene, const WaitingEvent* events, int count, int together,
                                         Vec3f* light);
template <>
void light_of_events_for<Target::neon>(const SceneView& scene, const WaitingEvent* events, int count, int together,
                                       Vec3f* light);

}  // namespace tyndall::test

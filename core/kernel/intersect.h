#pragma once
#include "core/kernel/tree.h"

/// The closest surface along a ray. A lane's hit is a function of its ray and the scene alone, whatever rays run beside
/// it: ties go to the lower element, and a box may cull a primitive only where the primitive's hit could not win.
namespace tyndall {

template <class F>
TYNDALL_INLINE Hit<F> closest_of_all(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_all(s, ray, Asked<F, false, false>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

template <class F>
TYNDALL_INLINE Hit<F> closest_in_tree(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_tree(s, ray, Asked<F, false, true>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

template <class F>
TYNDALL_INLINE Hit<F> closest(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  return s.nodes ? closest_in_tree(s, ray, active) : closest_of_all(s, ray, active);
}

/// Lanes whose way to `distance` is blocked by anything but element `aim`. If `aim` is a face of a box, the other faces
/// do block. common_aim: the element that all lanes aim at, or -1.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked_towards(const SceneView& s, const Ray<F>& ray, F distance, IntOf<F> aim,
                                         std::int32_t common_aim, MaskOf<F> active) {
  Hit<F> best{select(active, distance, F(-1.0f)), IntOf<F>(-1)};
  if (s.nodes)
    test_tree(s, ray, Asked<F, true, true>{F(0.0f), aim, common_aim}, best);
  else
    test_all(s, ray, Asked<F, true, false>{F(0.0f), aim, common_aim}, best);
  return less_equal(IntOf<F>(0), best.element);
}

/// The same on the way to a light.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked(const SceneView& s, const Ray<F>& ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, s.lights.count == 1 ? s.lights.element[0] : -1, active);
}

// The same as calls, for places that are not reached often: each inlined copy takes seconds to compile. They are given
// copies, for the path loop keeps its rays in registers.

template <class F>
[[gnu::noinline]] static Hit<F> call_closest(const SceneView& s, Ray<F> ray, MaskOf<F> active) {
  return closest(s, ray, active);
}

template <class F>
[[gnu::noinline]] static MaskOf<F> call_blocked(const SceneView& s, Ray<F> ray, F distance, IntOf<F> aim,
                                                MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, -1, active);
}

}  // namespace tyndall

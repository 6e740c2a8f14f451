#pragma once
#include "core/kernel/tree.h"

/// Finds the closest surface along a ray, and whether anything blocks a way. A lane's result depends on its own ray and
/// the scene alone, never on the rays in other lanes: of two hits at one distance the lower element wins, and a box may
/// rule out a primitive only if the primitive's hit could not win.
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

/// Lanes that would meet anything but element `aim` before `distance`. If `aim` is a face of a box, the box's other
/// faces do block. common_aim: the element that all lanes aim at, or -1 if they may aim at different ones.
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

/// The same for ways to lights. aim: the light's element.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked(const SceneView& s, const Ray<F>& ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, s.lights.count == 1 ? s.lights.element[0] : -1, active);
}

// The same as real function calls, for code that seldom runs: each inlined copy takes seconds to compile. They take
// rays by value, because a reference would force the path loop to keep its rays in memory instead of registers.

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

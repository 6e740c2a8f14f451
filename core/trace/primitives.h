#pragma once
#include "core/base/ray.h"
#include "core/shapes/box.h"
#include "core/shapes/outline.h"
#include "core/shapes/quad.h"
#include "core/shapes/sphere.h"
#include "core/trace/scene_view.h"

/// Tests rays against primitives and keeps the closest hit. Either each lane holds another ray and all test the same
/// primitive, or all lanes hold the same ray and each tests another primitive (single_ray.h).
namespace tyndall {

template <class F>
struct Hit {
  F t;               ///< infinity: nothing hit
  IntOf<F> element;  ///< -1: nothing hit
};

/// Factor by which boxes are widened, so that rounding cannot hide what is in them: far more than rounding needs, and
/// too little to cost time. T. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013.
inline constexpr float slab_room = 1.0f + 0x1p-17f;

/// The purpose of a test against primitives. is_shadow: only whether anything blocks the ray matters; the element at
/// which a lane aims does not block it. is_by_tree: the primitives are a leaf of the tree, whose box the lane enters at
/// `near`.
template <class F, bool is_shadow, bool is_by_tree>
struct RayQuery {
  static constexpr bool shadow = is_shadow, by_tree = is_by_tree;
  F near;                   ///< distance; infinity: the lane misses the leaf's box
  IntOf<F> aim;             ///< shadow rays: the element that does not block
  std::int32_t common_aim;  ///< the element that blocks in no lane, or -1
};

/// Lanes whose candidate, at distance t, is closer than their best hit so far. best.t is negative in inactive lanes.
template <class F, class Q>
TYNDALL_INLINE MaskOf<F> beats(F t, IntOf<F> element, MaskOf<F> hit, const Hit<F>& best, const Q& query) {
  const auto ahead = mask_and(hit, less(F(0.0f), t));
  auto closer = less(t, best.t);
  if constexpr (!Q::shadow) closer = mask_or(closer, mask_and(equal(t, best.t), less(element, best.element)));
  const auto better = mask_and(ahead, closer);
  if constexpr (Q::by_tree) return mask_and(better, less_equal(query.near, t * F(slab_room)));
  return better;
}

template <class F, class Q>
TYNDALL_INLINE void test_sphere(Vec3<F> center, F radius, IntOf<F> element, const Ray<F>& ray, const Q& query,
                                Hit<F>& best) {
  const Vec3<F> to_center = center - ray.origin;
  Interval<F> line = sphere_interval(to_center, radius, ray.direction);
  const Start<F> start = start_on<F>(ray.from, element);
  if (any(start.here)) line = leave_sphere(line, to_center, ray.direction, ray.from, start);
  if constexpr (Q::shadow) line.hit = mask_and_not(line.hit, equal(query.aim, element));
  if (!any(line.hit)) return;
  const F t = select(less(F(0.0f), line.near), line.near, line.far);
  const auto better = beats(t, element, line.hit, best, query);
  best.t = select(better, t, best.t);
  best.element = select(better, element, best.element);
}

template <bool moving, class F, class Q>
TYNDALL_INLINE void test_spheres(const Spheres& s, int first, int last, const Ray<F>& ray, const Q& query,
                                 Hit<F>& best) {
  for (int i = first; i < last; ++i) {
    Vec3<F> center = splat<F>(s.center[i]);
    if constexpr (moving) center = point_at(center, ray.time, splat<F>(s.move[i]));
    test_sphere(center, splat<F>(s.radius[i]), splat<F>(s.element[i]), ray, query, best);
  }
}

/// outlined: triangles and disks; else quads. A ray that nearly lies in a triangle's plane meets it at an uncertain
/// distance, but not before its box.
template <bool outlined, class F, class Q>
TYNDALL_INLINE void test_flats(const Flats& f, int first, int last, const Ray<F>& ray, const Q& query, Hit<F>& best) {
  for (int i = first; i < last; ++i) {
    if (Q::shadow && f.element[i] == query.common_aim) continue;
    const auto element = splat<F>(f.element[i]);
    QuadHit<F> h;
    if constexpr (outlined)
      h = hit_outlined(f.map[i], f.outline[i], ray.origin, ray.direction, best.t);
    else
      h = hit_quad(f.map[i], ray.origin, ray.direction, best.t);
    if constexpr (Q::shadow) h.hit = mask_and_not(h.hit, equal(query.aim, element));
    if (!any(h.hit)) continue;
    if constexpr (outlined && Q::by_tree) {
      const auto entered = less_equal(query.near, h.t * F(slab_room));
      if (f.outline[i].kind == Outline::triangle)
        h.t = select(entered, h.t, query.near);
      else
        h.hit = mask_and(h.hit, entered);
    }
    const Start<F> start = start_on<F>(ray.from, element);
    const RayQuery<F, Q::shadow, Q::by_tree && !outlined> not_entered{query.near, query.aim, query.common_aim};
    const auto better = beats(h.t, element, mask_and_not(h.hit, start.here), best, not_entered);
    best.t = select(better, h.t, best.t);
    best.element = select(better, element, best.element);
  }
}

/// Triangles and disks. Returns the closest hit. Not inlined, and by value, because each inlined copy takes seconds to
/// compile.
template <class F, class Q>
[[gnu::noinline]] static Hit<F> test_outlined(const Flats& f, int first, int last, Ray<F> ray, Q query, Hit<F> best) {
  test_flats<true>(f, first, last, ray, query, best);
  return best;
}

/// map: as for box_slabs(). element: the box's first face.
template <class F, class Q>
TYNDALL_INLINE void test_box(const auto& map, IntOf<F> element, Start<F> start, const Ray<F>& ray, const Q& query,
                             Hit<F>& best) {
  const BoxSlabs<F> slabs = box_slabs(map, ray.origin, ray.direction);
  Interval<F> line = slabs.inside;
  if (any(start.here)) line = leave_box(line, start);
  if (!any(line.hit)) return;
  const auto entering = less(F(0.0f), line.near);
  const F t = select(entering, line.near, line.far);
  if constexpr (Q::shadow) {
    const IntOf<F> face = query.aim - element;  // is it a face of this box?
    const auto aimed = mask_and(less(IntOf<F>(-1), face), less(face, IntOf<F>(6)));
    if (any(aimed)) line.hit = mask_and_not(line.hit, mask_and(aimed, equal(face, box_face(slabs, entering))));
  }
  const auto better = beats(t, element, line.hit, best, query);
  if (!any(better)) return;
  best.t = select(better, t, best.t);
  best.element = select(better, element + box_face(slabs, entering), best.element);
}

template <class F, class Q>
TYNDALL_INLINE void test_boxes(const Flats& b, int first, int last, const Ray<F>& ray, const Q& query, Hit<F>& best) {
  for (int i = first; i < last; ++i)
    test_box(b.map[i], splat<F>(b.element[i]), start_on<F>(ray.from, b.element[i], 6), ray, query, best);
}

template <class F, class Q>
TYNDALL_INLINE void test_all(const auto& s, const Ray<F>& ray, const Q& query, Hit<F>& best) {
  test_spheres<false>(s.spheres, 0, s.spheres.count(), ray, query, best);
  test_spheres<true>(s.moving_spheres, 0, s.moving_spheres.count(), ray, query, best);
  test_flats<false>(s.quads, 0, Q::shadow ? s.quads.count() - s.quads.bounding : s.quads.count(), ray, query, best);
  test_boxes(s.boxes, 0, s.boxes.count(), ray, query, best);
  if (s.has_outlined()) best = test_outlined(s.outlined, 0, s.outlined.count(), ray, query, best);
}

template <class F, class Q>
TYNDALL_INLINE void test_leaf(const auto& s, const BvhLeaf& leaf, const Ray<F>& ray, const Q& query, Hit<F>& best) {
  const int last = leaf.first + leaf.count;
  switch (leaf.kind) {
    case PrimitiveKind::sphere:
      test_spheres<false>(s.spheres, leaf.first, last, ray, query, best);
      break;
    case PrimitiveKind::moving_sphere:
      test_spheres<true>(s.moving_spheres, leaf.first, last, ray, query, best);
      break;
    case PrimitiveKind::quad:
      test_flats<false>(s.quads, leaf.first, last, ray, query, best);
      break;
    case PrimitiveKind::box:
      test_boxes(s.boxes, leaf.first, last, ray, query, best);
      break;
    case PrimitiveKind::outlined:
      if (s.has_outlined()) best = test_outlined(s.outlined, leaf.first, last, ray, query, best);
      break;
  }
}

}  // namespace tyndall

#pragma once
#include "core/base/ray.h"
#include "core/kernel/scene_view.h"
#include "core/shapes/box.h"
#include "core/shapes/quad.h"
#include "core/shapes/sphere.h"

/// The closest surface along a ray. A lane's hit is a function of its ray and the scene alone, whatever rays run beside
/// it: ties go to the lower element, and a box may cull a primitive only where the primitive's hit could not win.
namespace tyndall {

template <class F>
struct Hit {
  F t;               ///< infinity: nothing hit
  IntOf<F> element;  ///< -1: nothing hit
};

/// Relative room for the rounding of box tests: far more than it needs, far less than costs time.
/// T. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013.
inline constexpr float slab_room = 1.0f + 0x1p-17f;

/// How a primitive test is asked for. shadow: only whether something is in the way counts, and each lane leaves out the
/// element it aims at. by_tree: by a leaf of the tree, whose box a lane meets at `near`; infinity: it does not.
template <class F, bool is_shadow, bool is_by_tree>
struct Asked {
  static constexpr bool shadow = is_shadow, by_tree = is_by_tree;
  F near;
  IntOf<F> aim;             ///< shadow rays: the element that is left out
  std::int32_t common_aim;  ///< the one that all lanes leave out, or -1
};

/// Where candidate hits beat the best so far, whose distance is negative in lanes that are not asked.
template <class F, class Q>
TYNDALL_INLINE MaskOf<F> beats(F t, std::int32_t element, MaskOf<F> hit, const Hit<F>& best, const Q& asked) {
  const auto ahead = mask_and(hit, less(F(0.0f), t));
  auto closer = less(t, best.t);
  if constexpr (!Q::shadow) closer = mask_or(closer, mask_and(equal(t, best.t), less(IntOf<F>(element), best.element)));
  const auto better = mask_and(ahead, closer);
  if constexpr (Q::by_tree) return mask_and(better, less_equal(asked.near, t * F(slab_room)));
  return better;
}

template <class F, class Q>
TYNDALL_INLINE void test_sphere(Vec3<F> center, float radius, std::int32_t element, const Ray<F>& ray, const Q& asked,
                                Hit<F>& best) {
  const Vec3<F> to_center = center - ray.origin;
  Interval<F> line = sphere_interval(to_center, splat<F>(radius), ray.direction);
  const Start<F> start = start_on<F>(ray.from, element);
  if (any(start.here)) line = leave_sphere(line, to_center, ray.direction, ray.from, start);
  if constexpr (Q::shadow) line.hit = mask_and_not(line.hit, equal(asked.aim, IntOf<F>(element)));
  if (!any(line.hit)) return;
  const F t = select(less(F(0.0f), line.near), line.near, line.far);
  const auto better = beats(t, element, line.hit, best, asked);
  best.t = select(better, t, best.t);
  best.element = select(better, IntOf<F>(element), best.element);
}

template <class F, class Q>
TYNDALL_INLINE void test_spheres(const SphereView& s, int first, int last, const Ray<F>& ray, const Q& asked,
                                 Hit<F>& best) {
  for (int i = first; i < last; ++i)
    test_sphere(splat<F>(Vec3f{s.x[i], s.y[i], s.z[i]}), s.radius[i], s.element[i], ray, asked, best);
}

template <class F, class Q>
TYNDALL_INLINE void test_moving_spheres(const SphereView& s, int first, int last, const Ray<F>& ray, const Q& asked,
                                        Hit<F>& best) {
  for (int i = first; i < last; ++i) {
    const Vec3<F> way = splat<F>(Vec3f{s.move_x[i], s.move_y[i], s.move_z[i]});
    test_sphere(along(splat<F>(Vec3f{s.x[i], s.y[i], s.z[i]}), ray.time, way), s.radius[i], s.element[i], ray, asked,
                best);
  }
}

template <class F, class Q>
TYNDALL_INLINE void test_quads(const FlatView& q, int first, int last, const Ray<F>& ray, const Q& asked,
                               Hit<F>& best) {
  for (int i = first; i < last; ++i) {
    const std::int32_t element = q.element[i];
    if (Q::shadow && element == asked.common_aim) continue;
    QuadHit<F> h = hit_quad(q.map[i], ray.origin, ray.direction, best.t);
    if constexpr (Q::shadow) h.hit = mask_and_not(h.hit, equal(asked.aim, IntOf<F>(element)));
    if (!any(h.hit)) continue;
    const Start<F> start = start_on<F>(ray.from, element);
    const auto better = beats(h.t, element, mask_and_not(h.hit, start.here), best, asked);
    best.t = select(better, h.t, best.t);
    best.element = select(better, IntOf<F>(element), best.element);
  }
}

template <class F, class Q>
TYNDALL_INLINE void test_boxes(const FlatView& b, int first, int last, const Ray<F>& ray, const Q& asked,
                               Hit<F>& best) {
  for (int i = first; i < last; ++i) {
    const std::int32_t element = b.element[i];
    const BoxSlabs<F> slabs = box_slabs(b.map[i], ray.origin, ray.direction);
    const Start<F> start = start_on<F>(ray.from, element, 6);
    Interval<F> line = slabs.inside;
    if (any(start.here)) line = leave_box(line, start);
    if (!any(line.hit)) continue;
    const auto entering = less(F(0.0f), line.near);
    const F t = select(entering, line.near, line.far);
    if constexpr (Q::shadow) {
      const IntOf<F> face = asked.aim - IntOf<F>(element);  // one of its own faces?
      const auto aimed = mask_and(less(IntOf<F>(-1), face), less(face, IntOf<F>(6)));
      if (any(aimed)) line.hit = mask_and_not(line.hit, mask_and(aimed, equal(face, box_face(slabs, entering))));
    }
    const auto better = beats(t, element, line.hit, best, asked);
    if (!any(better)) continue;
    best.t = select(better, t, best.t);
    best.element = select(better, IntOf<F>(element) + box_face(slabs, entering), best.element);
  }
}

template <class F, class Q>
TYNDALL_INLINE void test_all(const SceneView& s, const Ray<F>& ray, const Q& asked, Hit<F>& best) {
  test_spheres(s.spheres, 0, s.spheres.count, ray, asked, best);
  test_moving_spheres(s.moving_spheres, 0, s.moving_spheres.count, ray, asked, best);
  test_quads(s.quads, 0, Q::shadow ? s.quads.hiding : s.quads.count, ray, asked, best);
  test_boxes(s.boxes, 0, s.boxes.count, ray, asked, best);
}

template <class F>
TYNDALL_INLINE Hit<F> closest_of_all(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_all(s, ray, Asked<F, false, false>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

/// A ray as the slab test wants it: box edge e is reached at e·slope + start.
template <class F>
struct Slopes {
  Vec3<F> slope, start;
};
template <class F>
TYNDALL_INLINE Slopes<F> slopes_of(const Ray<F>& ray) {
  const Vec3<F> slope{safe_reciprocal(ray.direction.x), safe_reciprocal(ray.direction.y),
                      safe_reciprocal(ray.direction.z)};
  return {slope, -(ray.origin * slope)};
}

/// Where lanes enter the box of child c of a node, if they meet it before `limit`.
/// Products and minima are monotonic in the box's edges, so a box within another is never entered before it.
template <class F>
struct Entry {
  MaskOf<F> meets;
  F near;
};
template <class F>
TYNDALL_INLINE Entry<F> enter_child(const BvhNode& node, int c, const Slopes<F>& s, F limit) {
  const auto low = [&](int axis) { return splat<F>(node.low[axis][c]); };
  const auto high = [&](int axis) { return splat<F>(node.high[axis][c]); };
  const F x0 = mul_add(low(0), s.slope.x, s.start.x), x1 = mul_add(high(0), s.slope.x, s.start.x);
  const F y0 = mul_add(low(1), s.slope.y, s.start.y), y1 = mul_add(high(1), s.slope.y, s.start.y);
  const F z0 = mul_add(low(2), s.slope.z, s.start.z), z1 = mul_add(high(2), s.slope.z, s.start.z);
  const F near = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), F(0.0f)));
  const F far = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), limit));
  return {less_equal(near, far * F(slab_room)), near};
}

/// Nodes still to visit, and where each lane enters them; infinity: it does not.
template <class F>
struct Stack {
  F near[bvh_stack];
  std::int32_t node[bvh_stack];
  int size = 0;

  /// Brings what the first lanes enter first among the nodes from `bottom` on to the top.
  TYNDALL_INLINE void raise_nearest(int bottom) {
    const int top = size - 1;
    int nearest = top;
    float least = least_lane(near[top]);
    for (int i = bottom; i < top; ++i) {
      const float key = least_lane(near[i]);
      nearest = key < least ? i : nearest;
      least = key < least ? key : least;
    }
    const F near_top = near[top];
    const std::int32_t node_top = node[top];
    near[top] = near[nearest], node[top] = node[nearest];
    near[nearest] = near_top, node[nearest] = node_top;
  }
};

template <class F, class Q>
TYNDALL_INLINE void test_leaf(const SceneView& s, const BvhLeaf& leaf, const Ray<F>& ray, const Q& asked,
                              Hit<F>& best) {
  const int last = leaf.first + leaf.count;
  switch (leaf.kind) {
    case PrimitiveKind::sphere:
      test_spheres(s.spheres, leaf.first, last, ray, asked, best);
      break;
    case PrimitiveKind::moving_sphere:
      test_moving_spheres(s.moving_spheres, leaf.first, last, ray, asked, best);
      break;
    case PrimitiveKind::quad:
      test_quads(s.quads, leaf.first, last, ray, asked, best);
      break;
    case PrimitiveKind::box:
      test_boxes(s.boxes, leaf.first, last, ray, asked, best);
      break;
  }
}

/// Through the tree, all lanes together; a lane takes part where its own ray meets a box. best.t: how far to look.
template <class F, class Q>
TYNDALL_INLINE void test_tree(const SceneView& s, const Ray<F>& ray, Q asked, Hit<F>& best) {
  const F infinity = F(__builtin_inff());
  const Slopes<F> slopes = slopes_of(ray);
  Stack<F> stack;
  std::int32_t current = 0;
  asked.near = F(0.0f);
  for (;;) {
    if (current >= 0) {
      const BvhNode& node = s.nodes[current];
      const int bottom = stack.size;
      for (int c = 0; c < node.count; ++c) {
        const Entry<F> child = enter_child(node, c, slopes, best.t);
        stack.near[stack.size] = select(child.meets, child.near, infinity);
        stack.node[stack.size] = node.child[c];
        stack.size += any(child.meets) ? 1 : 0;
      }
      if (stack.size > bottom + 1) stack.raise_nearest(bottom);
    } else {
      test_leaf(s, s.leaves[~current], ray, asked, best);
      if constexpr (Q::shadow) best.t = select(less(best.element, IntOf<F>(0)), best.t, F(-1.0f));
    }
    do {
      if (stack.size == 0) return;
      --stack.size;
      current = stack.node[stack.size];
      const F near = stack.near[stack.size];
      asked.near = select(less_equal(near, best.t * F(slab_room)), near, infinity);
    } while (!any(less(asked.near, infinity)));
  }
}

template <class F>
TYNDALL_INLINE Hit<F> closest_in_tree(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_tree(s, ray, Asked<F, false, true>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

/// Lanes whose way to `distance` is blocked by something else than element `aim`; the other faces of a box are in its
/// way.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked(const SceneView& s, const Ray<F>& ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  Hit<F> best{select(active, distance, F(-1.0f)), IntOf<F>(-1)};
  const std::int32_t common_aim = s.lights.count == 1 ? s.lights.element[0] : -1;
  if (s.nodes)
    test_tree(s, ray, Asked<F, true, true>{F(0.0f), aim, common_aim}, best);
  else
    test_all(s, ray, Asked<F, true, false>{F(0.0f), aim, common_aim}, best);
  return less_equal(IntOf<F>(0), best.element);
}

template <class F>
TYNDALL_INLINE Hit<F> closest(const SceneView& s, const Ray<F>& ray, MaskOf<F> active) {
  return s.nodes ? closest_in_tree(s, ray, active) : closest_of_all(s, ray, active);
}

}  // namespace tyndall

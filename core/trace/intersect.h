#pragma once
#include "core/trace/single_ray.h"

/// Finds the closest surface along a ray, and whether anything blocks a segment. A lane's result depends only on its
/// own ray and the scene, never on other lanes: of two hits at one distance the lower element wins, and a box may rule
/// out a primitive only if its hit could not win. Where there is a tree of boxes (core/compile/bvh.h), all lanes
/// traverse it together, as long as enough of them meet the same boxes; then each goes on alone (single_ray.h).
namespace tyndall {

/// Nodes still to be visited. near: distance at which each lane enters the node; infinity if it misses the node.
template <class F>
struct Stack {
  F near[bvh_stack];
  std::int32_t node[bvh_stack];
  int size = 0;

  /// Moves the node that any lane enters first, among those from index `bottom` on, to the top, to be visited next.
  TYNDALL_INLINE void raise_nearest(int bottom) {
    const int top = size - 1;
    int nearest = top;
    float minimum = min_lane(near[top]);
    for (int i = bottom; i < top; ++i) {
      const float key = min_lane(near[i]);
      nearest = key < minimum ? i : nearest;
      minimum = key < minimum ? key : minimum;
    }
    const F near_top = near[top];
    const std::int32_t node_top = node[top];
    near[top] = near[nearest], node[top] = node[nearest];
    near[nearest] = near_top, node[nearest] = node_top;
  }
};

/// If at most this many lanes have to enter a node, each goes on alone (single_ray.h): a test in all lanes would be
/// wasted on most of them. By measurement 4 of 32 and 2 of 16 lanes are best for the rays of paths, and twice as many
/// for rays in random order. Lanes always enter a leaf together: there is too little work in it to go alone.
template <class F>
inline constexpr int few_lanes = lanes_of<F> < bvh_width ? 0 : lanes_of<F> / 8;

/// Pops nodes until one may hold, for some lane, a hit closer than its best, and sets `node` to it. Returns a bit for
/// each such lane; 0: no node is left.
template <class F, class Q>
TYNDALL_INLINE std::uint32_t take_node(Stack<F>& stack, std::int32_t& node, Q& query, const Hit<F>& best) {
  const F infinity = F(__builtin_inff());
  while (stack.size > 0) {
    --stack.size;
    const F near = stack.near[stack.size];
    query.near = select(less_equal(near, best.t * F(slab_room)), near, infinity);
    const std::uint32_t live = bits(less(query.near, infinity));
    node = stack.node[stack.size];
    if (live) return live;
  }
  return 0;
}

/// Pushes the children of a node that some lane meets.
template <class F>
TYNDALL_INLINE void open_node(const BvhNode& node, const Slopes<F>& slopes, F limit, Stack<F>& stack) {
  const int bottom = stack.size;
  for (int c = 0; c < node.count; ++c) {
    const Entry<F> child = enter_boxes(
        [&](int axis) __attribute__((always_inline)) { return splat<F>(node.low[axis][c]); },
        [&](int axis) __attribute__((always_inline)) { return splat<F>(node.high[axis][c]); }, slopes, limit);
    stack.near[stack.size] = select(child.meets, child.near, F(__builtin_inff()));
    stack.node[stack.size] = node.child[c];
    stack.size += any(child.meets) ? 1 : 0;
  }
  if (stack.size > bottom + 1) stack.raise_nearest(bottom);
}

/// Replaces `best` in lanes that hit something closer. On entry best.t is the distance up to which each lane searches;
/// negative: the lane is inactive.
template <class F, class Q>
TYNDALL_INLINE void test_tree(const auto& s, const Ray<F>& ray, Q query, Hit<F>& best) {
  const Slopes<F> slopes = slopes_of(ray);
  SingleRays<F> alone;
  Stack<F> stack;
  stack.near[0] = F(0.0f);
  stack.node[0] = 0;
  stack.size = 1;
  std::int32_t node = 0;
  while (const std::uint32_t live = take_node(stack, node, query, best)) {
    if (node < 0) {
      test_leaf(s, s.bvh.leaves[~node], ray, query, best);
    } else if (__builtin_popcount(live) > few_lanes<F>) {
      open_node(s.bvh.nodes[node], slopes, best.t, stack);
      continue;
    } else if constexpr (few_lanes<F> > 0) {
      alone.remember(ray, slopes, query);
      store(alone.near, query.near);
      test_single_rays<F, Q>(s, alone, node, live, best);
    }
    if constexpr (Q::shadow) best.t = select(less(best.element, IntOf<F>(0)), best.t, F(-1.0f));
  }
}

/// What rays have met in the plane of the face that they leave. Only the rounding of their starts decides whether they
/// meet anything there.
template <class F>
struct OwnPlane {
  MaskOf<F>
      wrong;  ///< something that cannot be met: a flat beside them, or a face by which they have gone out of a box
  MaskOf<F> right;   ///< something that stands against the face: a box that they enter, or a flat beneath glass
  MaskOf<F> missed;  ///< nothing in a plane where glass has a face, though something may stand against the face
};
template <class F>
TYNDALL_INLINE OwnPlane<F> own_plane(const auto& s, const Ray<F>& ray, IntOf<F> met) {
  using I = IntOf<F>;
  const int count = s.elements.count();
  const auto plane_of = [&](I element, MaskOf<F> known) __attribute__((always_inline)) {
    return select(known, lookup<F>(s.elements.shared_plane, count, select(known, element, I(0))), I(-1));
  };
  const I left = as_int(shift_right<2>(as_uint(ray.from)));
  const I own = plane_of(left, less(left, I(count))), other = plane_of(met, less_equal(I(0), met));
  const auto is_set = [](I number, std::int32_t bit) __attribute__((always_inline)) {
    return equal(number & I(bit), I(bit));
  };
  const auto shared = less_equal(I(0), own);
  const auto same = mask_and(mask_and(shared, less_equal(I(0), other)),
                             equal(own & I(-SharedPlane::unit), other & I(-SharedPlane::unit)));
  const Vec3<F> normal = lookup<F>(s.elements.center_or_normal, count, select(same, met, I(0)));
  const auto is_box = is_set(other, SharedPlane::box), goes_out = less(F(0.0f), dot(normal, ray.direction));
  const auto leaves_inward =
      mask_and_not(is_set(own, SharedPlane::box), equal(ray.from & I(3), I(static_cast<std::int32_t>(Side::outward))));
  const auto leaves_glass = mask_and_not(is_set(own, SharedPlane::glass_box), leaves_inward);
  const auto is_wrong = mask_or(mask_and(is_box, goes_out), mask_not(mask_or(is_box, leaves_glass)));
  const auto may_miss = mask_and_not(mask_and(shared, is_set(own, SharedPlane::with_glass)), leaves_inward);
  return {mask_and(same, is_wrong), mask_and_not(same, is_wrong), mask_and_not(may_miss, same)};
}

template <class F>
TYNDALL_INLINE F largest_part(Vec3<F> v) {
  return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// The search of a few lanes. found: without a hit; its t is the distance up to which each lane searches, or negative.
template <class F, bool is_shadow>
[[gnu::noinline]] static Hit<F> search_from(const auto& s, Ray<F> ray, IntOf<F> aim, Hit<F> found) {
  if (s.bvh.nodes.empty())
    test_all(s, ray, RayQuery<F, is_shadow, false>{F(0.0f), aim, -1}, found);
  else
    test_tree(s, ray, RayQuery<F, is_shadow, true>{F(0.0f), aim, -1}, found);
  return found;
}

/// Where glass and another shape have faces in one plane, rounding decides which of them a ray meets first. It leaves
/// glass before it meets what stands against it, and meets a flat on glass before it enters.
template <class F>
[[gnu::noinline]] static Hit<F> in_order(const auto& s, Ray<F> ray, Hit<F> best) {
  using I = IntOf<F>;
  const int count = s.elements.count();
  const auto number_of = [&](I element) __attribute__((always_inline)) {
    const auto known = less_equal(I(0), element);
    return select(known, lookup<F>(s.elements.shared_plane, count, select(known, element, I(0))), I(-1));
  };
  const auto is_set = [](I number, std::int32_t bit) __attribute__((always_inline)) {
    return mask_and(less_equal(I(0), number), equal(number & I(bit), I(bit)));
  };
  const auto slope_at = [&](I element, MaskOf<F> lanes) __attribute__((always_inline)) {
    return dot(lookup<F>(s.elements.center_or_normal, count, select(lanes, element, I(0))), ray.direction);
  };
  const I met = number_of(best.element);
  auto lanes = is_set(met, SharedPlane::with_glass);
  if (!any(lanes)) return best;
  const F slope = slope_at(best.element, lanes);
  const F room = F(0x1p-16f) * largest_part(point_at(ray.origin, select(lanes, best.t, F(0.0f)), ray.direction)) /
                 max(abs(slope), F(0x1p-6f));
  const auto leaves = mask_and(is_set(met, SharedPlane::glass_box), less(F(0.0f), slope));
  lanes = mask_and_not(mask_and(lanes, less(room, best.t)), leaves);
  if (!any(lanes)) return best;
  ray.origin = point_at(ray.origin, select(lanes, best.t - room, F(0.0f)), ray.direction);
  ray.from = select(lanes, best.element * I(4), ray.from);
  const Hit<F> found = search_from<F, false>(s, ray, I(-1), {select(lanes, F(2.0f) * room, F(-1.0f)), I(-1)});
  const I other = number_of(found.element);
  const auto same = mask_and(is_set(other, SharedPlane::with_glass),
                             equal(met & I(-SharedPlane::unit), other & I(-SharedPlane::unit)));
  const auto leaves_first =
      mask_and(is_set(other, SharedPlane::glass_box), less(F(0.0f), slope_at(found.element, same)));
  const auto lies_on = mask_and_not(is_set(met, SharedPlane::glass_box), is_set(other, SharedPlane::box));
  best.element = select(mask_and(mask_and(lanes, same), mask_or(leaves_first, lies_on)), found.element, best.element);
  return best;
}

/// Searches again where rays leave planes in which several shapes lie: from a start that is moved back, where something
/// that stands against glass may have been missed; from one that is moved off the plane, by no more than it takes,
/// where something was met that cannot be. best: what the first search has found, up to the distance `limit`.
template <class F, bool is_shadow>
[[gnu::noinline]] static Hit<F> search_again(const auto& s, Ray<F> ray, F limit, IntOf<F> aim, Hit<F> best) {
  OwnPlane<F> plane = own_plane(s, ray, best.element);
  if constexpr (is_shadow) plane.missed = mask_and(plane.missed, less(best.element, IntOf<F>(0)));
  if (!any(mask_or(plane.wrong, plane.missed)))
    return is_shadow || !s.elements.planes_have_glass ? best : in_order(s, ray, best);
  const IntOf<F> left = as_int(shift_right<2>(as_uint(ray.from)));
  const Vec3<F> normal = lookup<F>(s.elements.center_or_normal, s.elements.count(),
                                   select(mask_or(plane.wrong, plane.missed), left, IntOf<F>(0)));
  const Vec3<F> off = copy_sign(largest_part(ray.origin), dot(normal, ray.direction)) * normal, origin = ray.origin;
  const auto search = [&](MaskOf<F> lanes, float part) {
    ray.origin = origin + F(part) * off;
    return search_from<F, is_shadow>(s, ray, aim, {select(lanes, limit, F(-1.0f)), IntOf<F>(-1)});
  };
  const auto take = [&](MaskOf<F> lanes, const Hit<F>& found) {
    best.t = select(lanes, found.t, best.t), best.element = select(lanes, found.element, best.element);
  };
  if (any(plane.missed)) {
    const Hit<F> found = search(plane.missed, -0x1p-18f);
    take(mask_and(plane.missed, own_plane(s, ray, found.element).right), found);
  }
  for (float part = 0x1p-23f; part < 0x1p-10f && any(plane.wrong); part *= 2) {
    const Hit<F> found = search(plane.wrong, part);
    take(plane.wrong, found);
    plane.wrong = mask_and(plane.wrong, own_plane(s, ray, found.element).wrong);
  }
  ray.origin = origin;
  return is_shadow || !s.elements.planes_have_glass ? best : in_order(s, ray, best);
}

/// Whether search_again() may find something else. What is met in the own plane is near: farther away only by light
/// that grazes it, of which next to nothing arrives.
template <class F>
TYNDALL_INLINE bool may_meet_own_plane(const auto& s, const Ray<F>& ray, const Hit<F>& best) {
  if (s.elements.shared_plane.empty()) return false;
  return s.elements.planes_have_glass ||
         any(mask_and(less_equal(IntOf<F>(0), best.element), less(best.t, F(0x1p-10f) * largest_part(ray.origin))));
}

template <class F>
TYNDALL_INLINE Hit<F> closest_of_all(const auto& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_all(s, ray, RayQuery<F, false, false>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

template <class F>
TYNDALL_INLINE Hit<F> closest_by_tree(const auto& s, const Ray<F>& ray, MaskOf<F> active) {
  Hit<F> best{select(active, F(__builtin_inff()), F(-1.0f)), IntOf<F>(-1)};
  test_tree(s, ray, RayQuery<F, false, true>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

template <class F>
TYNDALL_INLINE Hit<F> closest(const auto& s, const Ray<F>& ray, MaskOf<F> active) {
  const Hit<F> best = s.bvh.nodes.empty() ? closest_of_all(s, ray, active) : closest_by_tree(s, ray, active);
  if (!may_meet_own_plane(s, ray, best)) return best;
  return search_again<F, false>(shared_view(s), ray, F(__builtin_inff()), IntOf<F>(-1), best);
}

/// Lanes that hit anything but element `aim` before `distance`. If `aim` is a face of a box, the box's other faces do
/// block. common_aim: the element that all lanes aim at, or -1 if they may aim at different ones.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked_towards(const auto& s, const Ray<F>& ray, F distance, IntOf<F> aim,
                                         std::int32_t common_aim, MaskOf<F> active) {
  Hit<F> best{select(active, distance, F(-1.0f)), IntOf<F>(-1)};
  if (s.bvh.nodes.empty())
    test_all(s, ray, RayQuery<F, true, false>{F(0.0f), aim, common_aim}, best);
  else
    test_tree(s, ray, RayQuery<F, true, true>{F(0.0f), aim, common_aim}, best);
  if (may_meet_own_plane(s, ray, best)) best = search_again<F, true>(shared_view(s), ray, distance, aim, best);
  return less_equal(IntOf<F>(0), best.element);
}

/// blocked_towards() for shadow rays to lights. aim: the light's element; -1 towards the sky.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked(const auto& s, const Ray<F>& ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, s.lights.count() == 1 && !s.samples_sky() ? s.lights.element[0] : -1,
                         active);
}

// Non-inlined versions for code that seldom runs: each inlined copy takes seconds to compile. They take rays by value,
// because a reference would force the path loop to keep its rays in memory instead of registers.

template <class F>
[[gnu::noinline]] static Hit<F> call_closest(const SceneView& s, Ray<F> ray, MaskOf<F> active) {
  return closest(s, ray, active);
}

/// s: a shared_view().
template <class F>
[[gnu::noinline]] static MaskOf<F> call_blocked(const auto& s, Ray<F> ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, -1, active);
}

}  // namespace tyndall

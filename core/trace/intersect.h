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

/// Lanes whose ray has met a flat in the plane of the face that it leaves, or has gone out by such a face of a box. It
/// cannot: only the rounding of its start makes it.
template <class F>
TYNDALL_INLINE MaskOf<F> meets_own_plane(const auto& s, const Ray<F>& ray, IntOf<F> met) {
  using I = IntOf<F>;
  const int count = s.elements.count();
  const I left = as_int(shift_right<2>(as_uint(ray.from)));
  const auto known = mask_and(less_equal(I(0), met), less(left, I(count)));
  if (!any(known)) return known;
  const I plane = lookup<F>(s.elements.shared_plane, count, select(known, left, I(0)));
  const I other = lookup<F>(s.elements.shared_plane, count, select(known, met, I(0)));
  const auto same = mask_and(mask_and(known, less_equal(I(0), plane)), equal(plane | I(1), other | I(1)));
  if (!any(same)) return same;
  const Vec3<F> normal = lookup<F>(s.elements.center_or_normal, count, select(same, met, I(0)));
  return mask_and(same, mask_or(equal(other & I(1), I(0)), less(F(0.0f), dot(normal, ray.direction))));
}

template <class F>
TYNDALL_INLINE F largest_part(Vec3<F> v) {
  return max(max(abs(v.x), abs(v.y)), abs(v.z));
}
/// Whether some lane may have met its own plane. It is near: farther away only for light that grazes it, of which next
/// to nothing arrives.
template <class F>
TYNDALL_INLINE bool may_meet_own_plane(const auto& s, const Ray<F>& ray, const Hit<F>& best) {
  if (s.elements.shared_plane.empty()) return false;
  return any(mask_and(less_equal(IntOf<F>(0), best.element), less(best.t, F(0x1p-10f) * largest_part(ray.origin))));
}

// Non-inlined versions for code that seldom runs: each inlined copy takes seconds to compile. They take rays by value,
// because a reference would force the path loop to keep its rays in memory instead of registers.

/// limit: the distance up to which each lane searches; negative: the lane is inactive.
template <class F>
[[gnu::noinline]] static Hit<F> call_search(const SceneView& s, Ray<F> ray, F limit) {
  Hit<F> best{limit, IntOf<F>(-1)};
  if (s.bvh.nodes.empty())
    test_all(s, ray, RayQuery<F, false, false>{F(0.0f), IntOf<F>(-1), -1}, best);
  else
    test_tree(s, ray, RayQuery<F, false, true>{F(0.0f), IntOf<F>(-1), -1}, best);
  return best;
}

/// The search of lanes that have met their own plane, from a start that is moved off it, by no more than it takes.
/// best: what they have found; limit: the distance up to which they search; aim: the element that does not count, or
/// -1.
template <class F>
[[gnu::noinline]] static Hit<F> search_off_plane(const SceneView& s, Ray<F> ray, F limit, IntOf<F> aim, Hit<F> best) {
  const IntOf<F> left = as_int(shift_right<2>(as_uint(ray.from)));
  auto again = meets_own_plane(s, ray, best.element);
  for (float part = 0x1p-23f; part < 0x1p-10f && any(again); part *= 2) {
    const Vec3<F> normal = lookup<F>(s.elements.center_or_normal, s.elements.count(), select(again, left, IntOf<F>(0)));
    const F way = copy_sign(F(part) * largest_part(ray.origin), dot(normal, ray.direction));
    ray.origin = select(again, ray.origin + way * normal, ray.origin);
    const Hit<F> found = call_search(s, ray, select(again, limit, F(-1.0f)));
    best.t = select(again, found.t, best.t);
    best.element = select(again, select(equal(found.element, aim), IntOf<F>(-1), found.element), best.element);
    again = mask_and(again, meets_own_plane(s, ray, best.element));
  }
  return best;
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
  return search_off_plane(s, ray, F(__builtin_inff()), IntOf<F>(-1), best);
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
  if (may_meet_own_plane(s, ray, best)) best = search_off_plane(s, ray, distance, aim, best);
  return less_equal(IntOf<F>(0), best.element);
}

/// blocked_towards() for shadow rays to lights. aim: the light's element; -1 towards the sky.
template <class F>
TYNDALL_INLINE MaskOf<F> blocked(const auto& s, const Ray<F>& ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, s.lights.count() == 1 && !s.samples_sky() ? s.lights.element[0] : -1,
                         active);
}

// Not inlined: see call_search().

template <class F>
[[gnu::noinline]] static Hit<F> call_closest(const SceneView& s, Ray<F> ray, MaskOf<F> active) {
  const Hit<F> best = call_search(s, ray, select(active, F(__builtin_inff()), F(-1.0f)));
  if (!may_meet_own_plane(s, ray, best)) return best;
  return search_off_plane(s, ray, F(__builtin_inff()), IntOf<F>(-1), best);
}

/// s: a shared_view().
template <class F>
[[gnu::noinline]] static MaskOf<F> call_blocked(const auto& s, Ray<F> ray, F distance, IntOf<F> aim, MaskOf<F> active) {
  return blocked_towards(s, ray, distance, aim, -1, active);
}

}  // namespace tyndall

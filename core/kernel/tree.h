#pragma once
#include "core/kernel/lone_ray.h"

/// Takes rays through the tree of boxes (core/compile/bvh.h) to the primitives that they may meet. All lanes go from
/// node to node together, as long as enough of them meet the same boxes; then each goes on alone (lone_ray.h).
namespace tyndall {

/// Nodes that are still to be visited. near: the distance at which each lane enters the node; infinity if it misses it.
template <class F>
struct Stack {
  F near[bvh_stack];
  std::int32_t node[bvh_stack];
  int size = 0;

  /// Of the nodes from place `bottom` on, moves the one that any lane enters first to the top, to be visited next.
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

/// If no more lanes than this have to enter a node, each of them goes on alone (lone_ray.h): a test in all lanes would
/// be wasted on most of them. By measurement 4 of 32 and 2 of 16 lanes are best for the rays of paths, and twice as
/// many for rays in random order. Lanes always enter a leaf together: there is too little work in it to go alone.
template <class F>
inline constexpr int few_lanes = lanes_of<F> < bvh_width ? 0 : lanes_of<F> / 8;

/// Takes nodes off the stack until there is one in which some lane may find a hit closer than its best, and sets `node`
/// to it. Returns a bit for each such lane; 0: no node is left.
template <class F, class Q>
TYNDALL_INLINE std::uint32_t take_node(Stack<F>& stack, std::int32_t& node, Q& asked, const Hit<F>& best) {
  const F infinity = F(__builtin_inff());
  while (stack.size > 0) {
    --stack.size;
    const F near = stack.near[stack.size];
    asked.near = select(less_equal(near, best.t * F(slab_room)), near, infinity);
    const std::uint32_t live = bits(less(asked.near, infinity));
    node = stack.node[stack.size];
    if (live) return live;
  }
  return 0;
}

/// Puts those children of a node on the stack that some lane meets.
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

/// Replaces `best` in lanes that meet something closer. On entry best.t says how far each lane has to look; negative:
/// the lane takes no part.
template <class F, class Q>
TYNDALL_INLINE void test_tree(const SceneView& s, const Ray<F>& ray, Q asked, Hit<F>& best) {
  const Slopes<F> slopes = slopes_of(ray);
  LoneRays<F> alone;
  Stack<F> stack;
  stack.near[0] = F(0.0f);
  stack.node[0] = 0;
  stack.size = 1;
  std::int32_t node = 0;
  while (const std::uint32_t live = take_node(stack, node, asked, best)) {
    if (node < 0) {
      test_leaf(s, s.leaves[~node], ray, asked, best);
    } else if (__builtin_popcount(live) > few_lanes<F>) {
      open_node(s.nodes[node], slopes, best.t, stack);
      continue;
    } else if constexpr (few_lanes<F> > 0) {
      alone.remember(ray, slopes, asked);
      store(alone.near, asked.near);
      test_lone_rays<F, Q>(s, alone, node, live, best);
    }
    if constexpr (Q::shadow) best.t = select(less(best.element, IntOf<F>(0)), best.t, F(-1.0f));
  }
}

}  // namespace tyndall

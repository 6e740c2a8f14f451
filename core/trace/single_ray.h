#pragma once
#include "core/trace/primitives.h"

/// Traverses a part of the tree that few lanes enter with one ray at a time. All lanes then work for this ray: each
/// tests another box of a node, or another sphere or box of a leaf. The arithmetic is the same, and so are the hits.
namespace tyndall {

/// A ray in the form of the slab test: it reaches coordinate e of an axis at the distance e·slope + start.
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

/// Where lanes enter boxes, if they do so before the distance `limit`. low(axis), high(axis): bounds of the box. A box
/// within another is never entered before it, whatever the rounding: products, minima and maxima are monotonic.
template <class F>
struct Entry {
  MaskOf<F> meets;
  F near;
};
template <class F>
TYNDALL_INLINE Entry<F> enter_boxes(const auto& low, const auto& high, const Slopes<F>& s, F limit) {
  const F x0 = mul_add(low(0), s.slope.x, s.start.x), x1 = mul_add(high(0), s.slope.x, s.start.x);
  const F y0 = mul_add(low(1), s.slope.y, s.start.y), y1 = mul_add(high(1), s.slope.y, s.start.y);
  const F z0 = mul_add(low(2), s.slope.z, s.start.z), z1 = mul_add(high(2), s.slope.z, s.start.z);
  const F near = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), F(0.0f)));
  const F far = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), limit));
  return {less_equal(near, far * F(slab_room)), near};
}

/// The narrowest group of lanes that has one for each box of a node. Lanes beyond a node's last box hold unused
/// numbers.
template <class F>
struct RowFor {
  using type = F;
};
template <Doubled F>
requires(lanes_of<HalfOf<F>> >= bvh_width) struct RowFor<F> {
  using type = HalfOf<F>;
};

/// Nodes that a single ray still has to visit, and the distances at which it enters them.
struct SingleStack {
  int size = 0;
  float near[bvh_stack];
  std::int32_t node[bvh_stack];
};

/// One ray, the same in every lane of R, and the state of its traversal.
template <class R, class Q>
struct SingleRay {
  Ray<R> ray;
  Slopes<R> slopes;
  Q query;
  Hit<R> best;        ///< the same in all lanes
  std::int32_t node;  ///< the node being visited; below 0: leaf ~node
  float near;         ///< distance at which the ray enters that node

  /// Moves to the nearest child that the ray meets, and pushes the others. Returns false if it meets none.
  TYNDALL_INLINE bool open_node(const BvhNode& n, SingleStack& stack) {
    const Entry<R> entry = enter_boxes(
        [&](int axis) __attribute__((always_inline)) { return load<R>(n.low[axis]); },
        [&](int axis) __attribute__((always_inline)) { return load<R>(n.high[axis]); }, slopes, best.t);
    std::uint32_t met = bits(entry.meets) & ((1u << n.count) - 1u);
    if (!met) return false;
    alignas(64) float entered[lanes_of<R>];
    store(entered, entry.near);
    const int first = __builtin_ctz(met);
    near = entered[first], node = n.child[first];
    for (met &= met - 1; met; met &= met - 1) {
      const int c = __builtin_ctz(met);
      const bool nearer = entered[c] < near;
      stack.near[stack.size] = nearer ? near : entered[c];
      stack.node[stack.size] = nearer ? node : n.child[c];
      ++stack.size;
      near = nearer ? entered[c] : near;
      node = nearer ? n.child[c] : node;
    }
    return true;
  }

  /// Pops the next node that may hold something closer. Returns false if there is none.
  TYNDALL_INLINE bool take_node(SingleStack& stack) {
    const float limit = min_lane(best.t) * slab_room;
    while (stack.size > 0) {
      --stack.size;
      near = stack.near[stack.size], node = stack.node[stack.size];
      if (near <= limit) return true;
    }
    return false;
  }

  /// After each lane has tested another primitive: takes the closest hit of those that beat `best`; of equal ones the
  /// one with the lower element. valid: bit i is set if lane i held a primitive.
  TYNDALL_INLINE void take_best(const Hit<R>& each, std::uint32_t valid) {
    const std::uint32_t better = valid & ~bits(equal(each.element, best.element));
    if (!better) return;
    const float t = min_lane(select(mask_from_bits<R>(better), each.t, R(__builtin_inff())));
    alignas(64) std::int32_t elements[lanes_of<R>];
    store(elements, each.element);
    std::uint32_t nearest = better & bits(equal(each.t, splat<R>(t)));
    std::int32_t element = elements[__builtin_ctz(nearest)];
    for (nearest &= nearest - 1; nearest; nearest &= nearest - 1) {
      const std::int32_t other = elements[__builtin_ctz(nearest)];
      element = other < element ? other : element;
    }
    best = {splat<R>(t), splat<R>(element)};
  }

  template <bool moving>
  TYNDALL_INLINE void test_spheres(const Spheres& s, int first, int last) {
    for (int i = first; i < last; i += lanes_of<R>) {
      const int count = last - i < lanes_of<R> ? last - i : lanes_of<R>;
      const auto column = [&](const float* values) __attribute__((always_inline)) {
        return load_some<R>(values + i, count);
      };
      const auto vector = [&](const VectorColumn& v) __attribute__((always_inline)) {
        return Vec3<R>{column(v.x), column(v.y), column(v.z)};
      };
      Vec3<R> center = vector(s.center);
      if constexpr (moving) center = point_at(center, ray.time, vector(s.move));
      Hit<R> each = best;
      test_sphere(center, column(s.radius), load_some<R>(s.element + i, count), ray, query, each);
      take_best(each, (1u << count) - 1u);
    }
  }

  TYNDALL_INLINE void test_boxes(const Flats& b, int first, int last) {
    using I = IntOf<R>;
    for (int i = first; i < last; i += lanes_of<R>) {
      const int count = last - i < lanes_of<R> ? last - i : lanes_of<R>;
      const auto column = [&](int k) __attribute__((always_inline)) { return load_some<R>(b.column[k] + i, count); };
      AffineLanes<R> map;
      for (int k = 0; k < 3; ++k)
        map.row[k] = {column(3 * k), column(3 * k + 1), column(3 * k + 2)}, map.offset[k] = column(9 + k);
      const I element = load_some<R>(b.element + i, count), side = ray.from - I(4) * element;
      const auto here = mask_and(less(I(-1), side), less(side, I(24)));
      Hit<R> each = best;
      test_box(map, element, Start<R>{here, mask_and(here, equal(ray.from & I(3), I(0)))}, ray, query, each);
      take_best(each, (1u << count) - 1u);
    }
  }

  TYNDALL_INLINE void test_leaf(const auto& s, const BvhLeaf& leaf) {
    query.near = splat<R>(near);
    const int last = leaf.first + leaf.count;
    if (leaf.kind == PrimitiveKind::sphere)
      test_spheres<false>(s.spheres, leaf.first, last);
    else if (leaf.kind == PrimitiveKind::moving_sphere)
      test_spheres<true>(s.moving_spheres, leaf.first, last);
    else if (leaf.kind == PrimitiveKind::box)
      test_boxes(s.boxes, leaf.first, last);
    else if (s.has_outlined() && leaf.kind == PrimitiveKind::outlined)
      best = test_outlined(s.outlined, leaf.first, last, ray, query, best);
    else
      test_flats<false>(s.quads, leaf.first, last, ray, query, best);
  }

  TYNDALL_INLINE void run(const auto& s) {
    SingleStack stack;
    for (;;) {
      if (node >= 0) {
        if (open_node(s.bvh.nodes[node], stack)) continue;
      } else {
        test_leaf(s, s.bvh.leaves[~node]);
        if (Q::shadow && any(less_equal(IntOf<R>(0), best.element))) return;
      }
      if (!take_node(stack)) return;
    }
  }
};

/// The rays of a group of lanes, stored in memory so that single ones can be read.
template <class F>
struct SingleRays {
  static constexpr int lanes = lanes_of<F>;
  bool remembered = false;
  alignas(64) float origin[3][lanes], direction[3][lanes], slope[3][lanes], start[3][lanes], time[lanes];
  alignas(64) std::int32_t from[lanes], aim[lanes];
  std::int32_t common_aim;
  // Distances at which the rays enter a node, and their closest hits so far.
  alignas(64) float near[lanes], t[lanes];
  alignas(64) std::int32_t element[lanes];

  TYNDALL_INLINE void remember(const Ray<F>& ray, const Slopes<F>& slopes, const auto& query) {
    if (remembered) return;
    const auto store3 = [](auto& to, Vec3<F> v) __attribute__((always_inline)) {
      store(to[0], v.x), store(to[1], v.y), store(to[2], v.z);
    };
    store3(origin, ray.origin), store3(direction, ray.direction);
    store3(slope, slopes.slope), store3(start, slopes.start);
    store(time, ray.time), store(from, ray.from), store(aim, query.aim);
    common_aim = query.common_aim;
    remembered = true;
  }
};

/// Traverses everything beneath a node with the ray of lane k, and stores its closest hit in `rays`.
template <class F, class Q>
[[gnu::noinline]] static void test_single_ray(const auto& s, SingleRays<F>& rays, int k, std::int32_t node) {
  using R = typename RowFor<F>::type;
  const auto row3 = [k](const auto& column) __attribute__((always_inline)) {
    return Vec3<R>{splat<R>(column[0][k]), splat<R>(column[1][k]), splat<R>(column[2][k])};
  };
  SingleRay<R, RayQuery<R, Q::shadow, true>> single;
  single.ray = {row3(rays.origin), row3(rays.direction), splat<R>(rays.time[k]), splat<R>(rays.from[k])};
  single.slopes = {row3(rays.slope), row3(rays.start)};
  single.query = {splat<R>(rays.near[k]), splat<R>(rays.aim[k]), rays.common_aim};
  single.best = {splat<R>(rays.t[k]), splat<R>(rays.element[k])};
  single.node = node, single.near = rays.near[k];
  single.run(s);
  alignas(64) std::int32_t elements[lanes_of<R>];
  store(elements, single.best.element);
  rays.t[k] = min_lane(single.best.t), rays.element[k] = elements[0];
}

/// Calls test_single_ray() for each lane whose bit is set in `live`.
template <class F, class Q>
TYNDALL_INLINE void test_single_rays(const auto& s, SingleRays<F>& rays, std::int32_t node, std::uint32_t live,
                                     Hit<F>& best) {
  store(rays.t, best.t), store(rays.element, best.element);
  for (; live; live &= live - 1) test_single_ray<F, Q>(shared_view(s), rays, __builtin_ctz(live), node);
  best = {load<F>(rays.t), load<F>(rays.element)};
}

}  // namespace tyndall

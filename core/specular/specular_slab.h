#pragma once
#include "core/specular/specular_flat.h"

/// Lists the event sequences tried for a slab (for example: enter, reflect, leave) and the probability of each. Both
/// depend on the shading point and on the whole light: its point is drawn afterwards, on the side that the path meets.
namespace tyndall {

inline constexpr int max_images = 2;           ///< tried along each edge, to either side
inline constexpr float max_crossings = 13.0f;  ///< paths with more are left to BSDF sampling

/// A sphere that encloses a light at a given time.
template <class F>
TYNDALL_INLINE BoundingSphere<F> bounding_sphere(const LightColumns<F>& light, F time) {
  const F half_u = F(0.5f) * light.length_u, half_v = F(0.5f) * light.length_v;
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  return {select(round, sphere_light_center(light, time),
                 point_at(point_at(light.corner, half_u, light.edge_u), half_v, light.edge_v)),
          select(round, light.length_u, half_u + half_v)};
}

/// Bounds that hold for all paths with a given number of crossings to any point of a light, before they are solved.
template <class F>
struct SlabBounds {
  MaskOf<F> valid;         ///< the shading point and all of the light are outside of the slab
  F entry_min, entry_max;  ///< fraction of the path's extent along the faces that lies before its entry
  F leave_min, leave_max;  ///< the same before its exit
  F reach;                 ///< radius of the light's bounding sphere
};

/// s: its far point must be the centre of `light`.
template <class F>
TYNDALL_INLINE SlabBounds<F> bounds_of(const SlabFrame<F>& s, F crossings, const BoundingSphere<F>& light) {
  const F near = s.near_gap, close = max(s.far_gap - light.radius, F(0.0f)), wide = s.far_gap + light.radius;
  const F inside = F(2.0f) * crossings * s.half.height / s.index;
  const F skin = F(1e-5f) * (s.half.side[0] + s.half.side[1] + s.half.height);
  SlabBounds<F> b;
  b.valid = mask_and(less(skin, near), less(F(1.001f) * light.radius + skin, s.far_gap));
  const F one = F(1.0f), safe = max(near, F(1e-30f));
  b.entry_min = safe / (safe + wide + inside), b.entry_max = safe / (safe + close);
  b.leave_min = safe / (safe + wide), b.leave_max = one - close / (safe + close + inside);
  b.reach = light.radius;
  return b;
}

/// Whether a path to this image of the light along an edge may meet the faces. True for some paths that miss them, too.
template <class F>
TYNDALL_INLINE MaskOf<F> may_meet(const SlabFrame<F>& s, const SlabBounds<F>& b, int edge, F image) {
  const F middle = to_image(s, edge, image), low = middle - b.reach, high = middle + b.reach;
  const F half = F(1.0001f) * s.half.side[edge], near = s.near.side[edge];
  const F beyond = mul_add(F(-2.0f) * image, s.half.side[edge], near);
  const auto enters = mask_and(less_equal(near + min(low * b.entry_min, low * b.entry_max), half),
                               less_equal(-half, near + max(high * b.entry_min, high * b.entry_max)));
  const auto leaves = mask_and(less_equal(beyond + min(low * b.leave_min, low * b.leave_max), half),
                               less_equal(-half, beyond + max(high * b.leave_min, high * b.leave_max)));
  return mask_and(enters, leaves);
}

/// Whether a path meets no face that another object touches.
template <class F>
TYNDALL_INLINE MaskOf<F> is_open(const SpecularFlat<F>& slab, const SlabFrame<F>& s, const SlabSequence<F>& sequence) {
  using I = IntOf<F>;
  if (all(equal(slab.closed, I(0)))) return less(F(-1.0f), F(0.0f));
  const auto lower_of = [](I edge) __attribute__((always_inline)) {
    return select(equal(edge, I(0)), I(1), select(equal(edge, I(1)), I(4), I(16)));
  };
  const I first = next_edge<F>(sequence.across), edges[2] = {first, next_edge<F>(first)};
  const I entry = select(less(F(0.0f), s.near.height), I(2), I(1));
  I met = lower_of(sequence.across) * select(equal(sequence.crossings, F(0.0f)), entry, I(3));
  for (int k = 0; k < 2; ++k) {
    const F image = sequence.image[k];
    const I one = select(less(F(0.0f), image), I(2), select(less(image, F(0.0f)), I(1), I(0)));
    met = met + lower_of(edges[k]) * select(less(F(1.5f), abs(image)), I(3), one);
  }
  return equal(met & slab.closed, I(0));
}

/// Whether an event sequence is among those that draw_slab_sequence() may draw.
template <class F>
TYNDALL_INLINE MaskOf<F> is_looked_for(const SpecularFlat<F>& slab, const SlabFrame<F>& s,
                                       const BoundingSphere<F>& light, const SlabSequence<F>& sequence) {
  const SlabBounds<F> bounds = bounds_of(s, sequence.crossings, light);
  const F maximum = max(abs(sequence.image[0]), abs(sequence.image[1]));
  const auto even = less(F(0.0f), parity_sign(sequence.crossings));
  const auto same_side = mask_or(mask_and(even, s.same), mask_not(mask_or(even, s.same)));
  const auto few = mask_and(less_equal(sequence.crossings, F(max_crossings)),
                            less_equal(maximum, select(less(F(0.0f), sequence.crossings), F(max_images), F(0.0f))));
  const auto meets = mask_and(may_meet(s, bounds, 0, sequence.image[0]), may_meet(s, bounds, 1, sequence.image[1]));
  return mask_and(mask_and(mask_and(bounds.valid, same_side), few), mask_and(meets, is_open(slab, s, sequence)));
}

/// A number of crossings, and the probability with which it is drawn.
template <class F>
struct SlabCrossings {
  F count, probability;
};

/// Draws the number of crossings about as light on the straight path does. R: reflectance there. If the points are on
/// one side, 0 has probability (1 + R) / 2. Two more crossings are R² times as likely, R² clamped to [0.0625, 0.9].
template <class F>
TYNDALL_INLINE SlabCrossings<F> draw_crossings(const SlabFrame<F>& s, F u) {
  const F height = max(s.near_gap + s.far_gap, F(1e-30f)), x = to_image(s, 0, F(0.0f)), y = to_image(s, 1, F(0.0f));
  const F reflected = fresnel(height / sqrt(mul_add(height, height, mul_add(x, x, y * y))), s.index);
  const F further = min(max(reflected * reflected, F(0.0625f)), F(0.9f));  // for two more crossings
  const F off = select(s.same, mul_add(F(0.5f), reflected, F(0.5f)), F(0.0f));
  const F rest = min(max((F(1.0f) - u) / (F(1.0f) - off), F(1e-6f)), F(1.0f));
  F pairs = F(0.0f), chance = (F(1.0f) - off) * (F(1.0f) - further), left = further;
  for (int k = 2; k <= static_cast<int>(max_crossings) + 1; k += 2) {
    const auto more = less(rest, left);
    pairs = select(more, pairs + F(1.0f), pairs), chance = select(more, chance * further, chance);
    left = left * further;
  }
  const auto none = less(u, off);
  const F through = mul_add(F(2.0f), pairs, select(s.same, F(2.0f), F(1.0f)));
  return {select(none, F(0.0f), through), select(none, off, chance)};
}

/// The event sequences that may be drawn for a shading point.
template <class F>
struct SlabSequences {
  static constexpr int images = 2 * max_images + 1, room = 3 * images * images;
  F weight[room];
  int across[room], image[room][2];
  SlabCrossings<F> crossings[3];
  int count = 0;
};

/// Estimated contribution of an event sequence, given its crossings. normal: of the surface at the shading point; 0 in
/// media. blur: tolerance at the edges of the faces, in scene units.
template <class F>
TYNDALL_INLINE F slab_weight(const SlabFrame<F>& s, const SlabSequence<F>& sequence, const SlabPlace<F>& normal,
                             F blur) {
  const FramedPath<F> path = path_of_slope(s, sequence, find_slope(s, sequence, 2));
  const F up = select(less(F(0.0f), s.near.height), -normal.height, normal.height);
  const F cosine = mul_add(path.gone[0], normal.side[0], mul_add(path.gone[1], normal.side[1], up)) /
                   sqrt(mul_add(path.slope, path.slope, F(1.0f)));
  const auto in_medium = equal(abs(normal.side[0]) + abs(normal.side[1]) + abs(normal.height), F(0.0f));
  const F meets = select(meets_faces(s, sequence, path.gone, blur), F(1.0f), F(0.02f));
  return meets * path.throughput * select(in_medium, F(1.0f), max(cosine, F(0.02f))) / max(path.spread, F(1e-30f));
}

/// Lists the event sequences of paths that enter at the ends of the edge `across`.
template <class F>
TYNDALL_INLINE void list_sequences(const SpecularFlat<F>& slab, const SlabFrame<F>& s, const BoundingSphere<F>& light,
                                   const SlabPlace<F>& normal, int across, MaskOf<F> lanes,
                                   SlabSequences<F>& sequences) {
  const SlabCrossings<F>& crossings = sequences.crossings[across];
  const SlabBounds<F> bounds = bounds_of(s, crossings.count, light);
  const auto valid = mask_and(mask_and(lanes, bounds.valid), less_equal(crossings.count, F(max_crossings)));
  if (!any(valid)) return;
  const F blur = mul_add(F(0.01f), s.half.side[0] + s.half.side[1], light.radius);
  const auto reflected = equal(crossings.count, F(0.0f));
  for (int i = -max_images; i <= max_images; ++i) {
    const F first = F(static_cast<float>(i));
    auto may = mask_and(valid, may_meet(s, bounds, 0, first));
    if (i != 0) may = mask_and_not(may, reflected);
    for (int k = -max_images; k <= max_images && any(may); ++k) {
      const F second = F(static_cast<float>(k));
      auto here = mask_and(may, may_meet(s, bounds, 1, second));
      if (k != 0) here = mask_and_not(here, reflected);
      const SlabSequence<F> sequence{IntOf<F>(across), crossings.count, {first, second}};
      if (any(here)) here = mask_and(here, is_open(slab, s, sequence));
      if (!any(here)) continue;
      const F weight = slab_weight(s, sequence, normal, blur) / crossings.probability;
      sequences.weight[sequences.count] = select(here, max(weight, F(1e-30f)), F(0.0f));
      sequences.across[sequences.count] = across;
      sequences.image[sequences.count][0] = i, sequences.image[sequences.count][1] = k;
      ++sequences.count;
    }
  }
}

/// An event sequence, drawn from all that are possible for a shading point.
template <class F>
struct DrawnSlabSequence {
  SlabSequence<F> sequence;
  MaskOf<F> drawn;  ///< false where none is possible
  F probability;
};

template <class F>
TYNDALL_INLINE DrawnSlabSequence<F> take_sequence(const SlabSequences<F>& sequences, F u) {
  using I = IntOf<F>;
  F total = F(0.0f);
  for (int i = 0; i < sequences.count; ++i) total = total + sequences.weight[i];
  DrawnSlabSequence<F> out{{I(0), F(0.0f), {F(0.0f), F(0.0f)}}, less(F(0.0f), total), F(1.0f)};
  F left = u * total, weight = F(1.0f);
  auto open = out.drawn;
  for (int i = 0; i < sequences.count && any(open); ++i) {
    const auto here = mask_and(open, less(F(0.0f), sequences.weight[i]));
    const SlabCrossings<F>& crossings = sequences.crossings[sequences.across[i]];
    out.sequence.across = select(here, I(sequences.across[i]), out.sequence.across);
    out.sequence.crossings = select(here, crossings.count, out.sequence.crossings);
    for (int k = 0; k < 2; ++k)
      out.sequence.image[k] = select(here, F(static_cast<float>(sequences.image[i][k])), out.sequence.image[k]);
    weight = select(here, sequences.weight[i], weight);
    out.probability = select(here, crossings.probability, out.probability);
    open = mask_and_not(open, mask_and(here, less(left, sequences.weight[i])));
    left = left - sequences.weight[i];
  }
  out.probability = out.probability * weight / max(total, F(1e-37f));
  return out;
}

/// Draws an event sequence for a shading point. normal: of the surface there; 0 in media. u: two random numbers.
template <class F>
TYNDALL_INLINE DrawnSlabSequence<F> draw_slab_sequence(const SpecularFlat<F>& slab, Vec3<F> point, Vec3<F> normal,
                                                       const BoundingSphere<F>& light, Pair<F> u, MaskOf<F> lanes) {
  SlabSequences<F> sequences;
  const F edges[3] = {dot(slab.row[0], normal), dot(slab.row[1], normal), dot(slab.row[2], normal)};
  for (int across = 0; across < 3; ++across) {
    const IntOf<F> edge(across);
    const SlabFrame<F> s = slab_frame(slab, point, light.center, edge);
    sequences.crossings[across] = draw_crossings(s, u.x);
    list_sequences(slab, s, light, framed<F>(edges, edge), across, lanes, sequences);
  }
  return take_sequence(sequences, u.y);
}

/// The sphere in which a light sees the shading point through the slab. s: its far point does not matter.
template <class F>
TYNDALL_INLINE BoundingSphere<F> seen_by_slab(const SpecularFlat<F>& slab, const SlabFrame<F>& s,
                                              const SlabSequence<F>& sequence) {
  const F height = copy_sign(F(1.0f), s.near.height) *
                   mul_add(F(2.0f) * s.half.height, sequence.crossings - F(1.0f), abs(s.near.height));
  F side[2];
  for (int k = 0; k < 2; ++k)
    side[k] = parity_sign(sequence.image[k]) * mul_add(F(-2.0f) * sequence.image[k], s.half.side[k], s.near.side[k]);
  const IntOf<F> first = next_edge<F>(sequence.across);
  BoundingSphere<F> b{zero3<F>(), F(2.0f) * sequence.crossings * s.half.height};
  for (int k = 0; k < 3; ++k) {
    const IntOf<F> edge(k);
    const F place = select(equal(edge, sequence.across), -parity_sign(sequence.crossings) * height,
                           select(equal(edge, first), side[0], side[1]));
    b.center = point_at(b.center, place - slab.offset[k], slab.row[k]);
  }
  return b;
}

/// Estimated contribution, > 0, of pair k of a slab and a light at a point: that of the light alone if the straight
/// segment to it meets the sphere around the slab, else 0.15 times as much, because reflections may still bring light.
template <class F>
TYNDALL_INLINE F slab_worth(const SpecularPairs& c, int k, Vec3<F> point) {
  const int sphere = c.sphere[k];
  const Vec3<F> to_light = splat<F>(c.choice.center[k]) - point, arm = splat<F>(c.center[sphere]) - point;
  const F distance2 = dot(to_light, to_light), reach2 = splat<F>(c.choice.reach2[k]);
  const F nearest = min(max(dot(arm, to_light) / max(distance2, F(1e-30f)), F(0.0f)), F(1.0f));  // on the segment
  const Vec3<F> off = point_at(arm, -nearest, to_light);
  const F radius = splat<F>(c.radius[sphere]) + sqrt(reach2);
  const F part = select(less(dot(off, off), radius * radius), F(1.0f), F(0.15f));
  return part * splat<F>(c.choice.power[k]) / max(distance2, reach2);
}

/// Estimated contribution, > 0, of pair k of a sphere, mirror or slab and a light at a point: see light_worth() of
/// lights.
template <class F>
TYNDALL_INLINE F light_worth(const SpecularPairs& c, int k, Vec3<F> point) {
  if (c.sphere[k] < c.first_mirror) return light_worth(c.choice, k, point);
  return c.sphere[k] < c.first_slab ? mirror_worth(c, k, point) : slab_worth(c, k, point);
}

}  // namespace tyndall

#pragma once
#include "core/specular/specular_path.h"

/// Specular paths off flat mirrors and through slabs.
///
/// Mirrors are quads, and faces of boxes, of metal without fuzz. A mirror shows a light as an image behind it, so that
/// there is at most one path between two points on the same side, and only if it meets the face.
///
/// Slabs are boxes of glass. Light that enters a box by one face and then meets a face at right angles to it is totally
/// reflected there if the index is at least sqrt(2), so that it leaves only by the entry face or the opposite one.
/// Unfolded at the faces that reflect it, the path is one through a slab with parallel sides to an image of the far
/// end, and has one slope outside by Snell's law. So there is at most one path between two points for each number of
/// crossings and each image.
namespace tyndall {

/// A flat mirror or a slab: see FlatRecord.
template <class F>
struct SpecularFlat {
  Vec3<F> row[3];
  F offset[3];
  F half[3];                ///< slabs: half the length of each edge
  F index, medium_density;  ///< slabs: refractive index; density of media inside
  IntOf<F> closed;          ///< slabs: bit 2 · edge + (0: lower face, 1: upper face): another object touches that face
  IntOf<F> element;         ///< index of the first face among the scene's elements
};

/// Reads a flat mirror or a slab. flat: index among these.
template <class F>
TYNDALL_INLINE SpecularFlat<F> load_flat(const SpecularPairs& c, IntOf<F> flat) {
  using Record = FlatRecord;
  const auto its = record_in<F>(c.flats, flat);
  SpecularFlat<F> p;
  for (int k = 0; k < 3; ++k)
    p.row[k] = its(&Record::row, k), p.offset[k] = its(&Record::offset, k), p.half[k] = its(&Record::size, k);
  p.index = its(&Record::index), p.medium_density = its(&Record::medium_density), p.closed = its(&Record::closed);
  p.element = lookup<F>(c.outer, c.spheres(), flat + IntOf<F>(c.first_mirror));
  return p;
}

/// The mirror image of a point.
template <class F>
TYNDALL_INLINE Vec3<F> mirrored(const SpecularFlat<F>& m, Vec3<F> point) {
  return point_at(point, F(-2.0f) * (dot(m.row[2], point) + m.offset[2]), m.row[2]);
}

/// Factor of mirror_worth() where the point does not see the middle of the light in the mirror. It may still see other
/// parts.
inline constexpr float min_mirror_worth = 1e-3f;

/// Estimated contribution, > 0, of pair k of a mirror and a light at a point: light_worth() of the light's mirror
/// image.
template <class F>
TYNDALL_INLINE F mirror_worth(const SpecularPairs& c, int k, Vec3<F> point) {
  const FlatRecord& m = c.flats[c.sphere[k] - c.first_mirror];
  const Vec3<F> light = splat<F>(c.choice.center[k]);
  const Vec3<F> normal = splat<F>(m.row[2]);
  const F offset = splat<F>(m.offset[2]), near = dot(normal, point) + offset, far = dot(normal, light) + offset;
  const F height = max(abs(near) + abs(far), F(1e-30f)), up_to_plane = abs(near) / height;  // fraction of the path
  const Vec3<F> to_light = point_at(light, F(-2.0f) * far, normal) - point, at = point_at(point, up_to_plane, to_light);
  const F distance2 = dot(to_light, to_light), reach2 = splat<F>(c.choice.reach2[k]);
  const F blur =
      up_to_plane * sqrt(reach2 * distance2) / height;  // how far from `at` other points of the light may be seen
  auto seen = less(F(0.0f), near * far);
  for (int i = 0; i < 2; ++i) {
    const F place = abs(dot(splat<F>(m.row[i]), at) + splat<F>(m.offset[i]));
    seen = mask_and(seen, less_equal(place, mul_add(blur, splat<F>(m.size[i]), F(1.0f))));
  }
  return splat<F>(c.choice.power[k]) / max(distance2, reach2) * select(seen, F(1.0f), F(min_mirror_worth));
}

/// The path off a mirror between two points: found if it meets the face, and the points are on one side.
template <class F>
TYNDALL_INLINE SpecularPath<F> mirror_path(const SpecularFlat<F>& m, Vec3<F> near, Vec3<F> far) {
  const F below = dot(m.row[2], near) + m.offset[2], above = dot(m.row[2], far) + m.offset[2];
  const Vec3<F> image = mirrored(m, near), offset = far - image;
  const F distance = max(length(offset), F(1e-30f));
  const F up_to_plane = abs(below) / max(abs(below) + abs(above), F(1e-30f));  // fraction of the path
  const Vec3<F> at = point_at(image, up_to_plane, offset);
  SpecularPath<F> w;
  w.wall = m.element, w.from = m.element * IntOf<F>(4) + select(less(above, F(0.0f)), IntOf<F>(1), IntOf<F>(0));
  w.arrive = (F(1.0f) / distance) * offset;
  w.direction = reflect(w.arrive, m.row[2]);
  w.near_distance = up_to_plane * distance, w.far_distance = distance - w.near_distance;
  w.spread = distance * distance;
  const F edge = max(abs(dot(m.row[0], at) + m.offset[0]), abs(dot(m.row[1], at) + m.offset[1]));
  w.found = mask_and(less(F(0.0f), below * above), less_equal(edge, F(1.0f)));
  return w;
}

/// The event sequence of a path at a slab.
template <class F>
struct SlabSequence {
  IntOf<F> across;  ///< the edge at whose end the path enters
  F crossings;      ///< crossings from one of the faces there to the other; 0: reflected off the outside
  F image[2];  ///< reflections at the side faces, for the two edges that follow `across`; negative if the lower face
               ///< comes first
};

/// value[edge] in every lane, of numbers or vectors.
template <class F>
TYNDALL_INLINE auto of_edge(const auto(&value)[3], IntOf<F> edge) {
  return select(equal(edge, IntOf<F>(0)), value[0], select(equal(edge, IntOf<F>(1)), value[1], value[2]));
}

/// The edge that follows in the order 0, 1, 2, 0.
template <class F>
TYNDALL_INLINE IntOf<F> next_edge(IntOf<F> edge) {
  return select(equal(edge, IntOf<F>(2)), IntOf<F>(0), edge + IntOf<F>(1));
}

/// A position by its components along the edges: `height` along the edge `across`, `side` along the two that follow it.
template <class F>
struct SlabPlace {
  F side[2], height;
};

template <class F>
TYNDALL_INLINE SlabPlace<F> framed(const F (&edges)[3], IntOf<F> across) {
  const IntOf<F> first = next_edge<F>(across);
  return {{of_edge<F>(edges, first), of_edge<F>(edges, next_edge<F>(first))}, of_edge<F>(edges, across)};
}

template <class F>
TYNDALL_INLINE SlabPlace<F> framed(const SpecularFlat<F>& slab, Vec3<F> point, IntOf<F> across) {
  const F edges[3] = {dot(slab.row[0], point) + slab.offset[0], dot(slab.row[1], point) + slab.offset[1],
                      dot(slab.row[2], point) + slab.offset[2]};
  return framed<F>(edges, across);
}

/// A slab and the two ends of a path, in the frame of an event sequence.
template <class F>
struct SlabFrame {
  SlabPlace<F> half, near, far;
  F near_gap, far_gap;  ///< distance of each point from the slab, along `across`; negative: it is in the slab
  F index;
  MaskOf<F> same;  ///< both points are on the same side of the slab
};

template <class F>
TYNDALL_INLINE SlabFrame<F> slab_frame(const SpecularFlat<F>& slab, Vec3<F> near, Vec3<F> far, IntOf<F> across) {
  SlabFrame<F> s;
  s.half = framed<F>(slab.half, across);
  s.near = framed(slab, near, across), s.far = framed(slab, far, across);
  s.near_gap = abs(s.near.height) - s.half.height, s.far_gap = abs(s.far.height) - s.half.height;
  s.index = slab.index;
  s.same = less(F(0.0f), s.near.height * s.far.height);
  return s;
}

/// 1 where a whole number is even, -1 where it is odd.
template <class F>
TYNDALL_INLINE F parity_sign(F whole) {
  return select(equal(floor(F(0.5f) * whole) * F(2.0f), whole), F(1.0f), F(-1.0f));
}

/// Distance along one edge from the near point to the image of the far point, signed.
template <class F>
TYNDALL_INLINE F to_image(const SlabFrame<F>& s, int edge, F image) {
  return mul_add(F(2.0f) * image, s.half.side[edge], parity_sign(image) * s.far.side[edge]) - s.near.side[edge];
}

/// A path through a slab in the frame of its event sequence.
template <class F>
struct FramedPath {
  F slope;               ///< outside: the tangent of its angle to the normal of the faces
  F gone[2];             ///< distance that the path covers along each edge per unit of height outside
  F throughput, spread;  ///< see SpecularPath
};

/// Height that the path of an event sequence covers outside and inside of the glass.
template <class F>
TYNDALL_INLINE Pair<F> heights_of(const SlabFrame<F>& s, const SlabSequence<F>& sequence) {
  return {max(s.near_gap + s.far_gap, F(1e-30f)), F(2.0f) * sequence.crossings * s.half.height};
}

/// Solves for the slope of the path of an event sequence, by Newton's method. The distance that a path covers along the
/// faces is a concave function of the slope, so that each step from below falls short and none overshoots.
template <class F>
TYNDALL_INLINE F find_slope(const SlabFrame<F>& s, const SlabSequence<F>& sequence, int steps) {
  const auto [outside, inside] = heights_of(s, sequence);
  const F x = to_image(s, 0, sequence.image[0]), y = to_image(s, 1, sequence.image[1]);
  const F across = sqrt(mul_add(x, x, y * y));
  const F n2 = s.index * s.index, more = (s.index - F(1.0f)) * (s.index + F(1.0f));
  const F maximum = inside / sqrt(more);  // largest distance inside
  F slope = max(across / (outside + inside / s.index), (across - maximum) / outside);
  for (int i = 0; i < steps; ++i) {
    const F w = F(1.0f) / sqrt(mul_add(more, slope * slope, n2)), t = slope * w;
    slope = (across - inside * more * (t * t * t)) / mul_add(inside * n2, w * w * w, outside);
  }
  return slope;
}

/// The path of an event sequence that has a given slope.
template <class F>
TYNDALL_INLINE FramedPath<F> path_of_slope(const SlabFrame<F>& s, const SlabSequence<F>& sequence, F slope) {
  const auto [outside, inside] = heights_of(s, sequence);
  const F n2 = s.index * s.index, more = (s.index - F(1.0f)) * (s.index + F(1.0f));
  const F w2 = mul_add(more, slope * slope, n2), w = sqrt(w2);
  const F reach = outside + inside / w;                      // the path covers slope · reach along the faces
  const F growth = mul_add(inside, n2 / (w2 * w), outside);  // derivative of that product by the slope
  const F stretch2 = mul_add(slope, slope, F(1.0f)), cosine = F(1.0f) / sqrt(stretch2);
  const F reflected = fresnel(cosine, s.index), passed = F(1.0f) - reflected;
  const F through = passed * passed * whole_power(reflected, max(sequence.crossings - F(1.0f), F(0.0f)));
  return {slope,
          {to_image(s, 0, sequence.image[0]) / reach, to_image(s, 1, sequence.image[1]) / reach},
          select(equal(sequence.crossings, F(0.0f)), reflected, through),
          reach * growth * stretch2};
}

/// Whether the path of an event sequence enters through its entry face and leaves through its exit face; both are
/// widened by `room` on each side. gone: distance that the path covers along each edge per unit of height outside.
template <class F>
TYNDALL_INLINE MaskOf<F> meets_faces(const SlabFrame<F>& s, const SlabSequence<F>& sequence, const F (&gone)[2],
                                     F room) {
  auto meets = less(F(-1.0f), F(0.0f));
  for (int k = 0; k < 2; ++k) {
    const F entry = mul_add(gone[k], s.near_gap, s.near.side[k]),
            to = to_image(s, k, sequence.image[k]) + s.near.side[k];
    const F exit = mul_add(F(-2.0f) * sequence.image[k], s.half.side[k], to - gone[k] * s.far_gap);
    meets = mask_and(meets, less_equal(max(abs(entry), abs(exit)), s.half.side[k] + room));
  }
  return meets;
}

/// Solves for the path of an event sequence. Both points must be outside of the slab.
template <class F>
TYNDALL_INLINE SpecularPath<F> slab_path(const SpecularFlat<F>& slab, const SlabFrame<F>& s,
                                         const SlabSequence<F>& sequence) {
  constexpr int steps = std::is_same_v<F, double> ? 40 : 6;
  const FramedPath<F> solved = path_of_slope(s, sequence, find_slope(s, sequence, steps));
  SpecularPath<F> path;
  path.throughput = solved.throughput, path.spread = solved.spread;
  path.found = meets_faces(s, sequence, solved.gone, F(0.0f));
  const F stretch = sqrt(mul_add(solved.slope, solved.slope, F(1.0f))), cosine = F(1.0f) / stretch;
  path.near_distance = s.near_gap * stretch, path.far_distance = s.far_gap * stretch;
  const F sine = solved.slope * cosine / s.index, inside = heights_of(s, sequence).y;
  path.optical_depth = slab.medium_density * (inside / sqrt(max(F(1.0f) - sine * sine, F(1e-12f))));
  // The two faces across one edge are elements that follow each other, the lower one first.
  const IntOf<F> lower = slab.element + sequence.across + sequence.across, upper = lower + IntOf<F>(1);
  path.wall = select(less(F(0.0f), s.near.height), upper, lower);
  path.from = select(less(F(0.0f), s.far.height), upper, lower) * IntOf<F>(4);
  const IntOf<F> edge[3] = {next_edge<F>(sequence.across), next_edge<F>(next_edge<F>(sequence.across)),
                            sequence.across};
  const F up = copy_sign(cosine, s.near.height);
  const F leave[3] = {cosine * solved.gone[0], cosine * solved.gone[1], -up};
  const F arrive[3] = {parity_sign(sequence.image[0]) * leave[0], parity_sign(sequence.image[1]) * leave[1],
                       select(s.same, up, -up)};
  path.direction = path.arrive = zero3<F>();
  for (int k = 0; k < 3; ++k) {
    const Vec3<F> row = of_edge<F>(slab.row, edge[k]);
    path.direction = point_at(path.direction, leave[k], row), path.arrive = point_at(path.arrive, arrive[k], row);
  }
  return path;
}

}  // namespace tyndall

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

template <class F>
struct SpecularMirror {
  Vec3<F> row[2], normal;  ///< row · p + offset runs from -1 to 1 across the face, for a point p
  F offset[2], height;     ///< normal · p + height: distance of p from the mirror's plane, negative behind it
};

/// Reads a mirror. mirror: index among the flat mirrors.
template <class F>
TYNDALL_INLINE SpecularMirror<F> load_mirror(const SpecularView& c, IntOf<F> mirror) {
  const IntOf<F> at = mirror * IntOf<F>(numbers_of_mirror);
  const auto value = [&](int k) { return gather<F>(c.mirrors + k, at); };
  const auto row = [&](int k) { return Vec3<F>{value(3 * k), value(3 * k + 1), value(3 * k + 2)}; };
  return {{row(0), row(1)}, row(2), {value(mirror_offsets), value(mirror_offsets + 1)}, value(mirror_offsets + 2)};
}

/// The mirror image of a point.
template <class F>
TYNDALL_INLINE Vec3<F> mirrored(const SpecularMirror<F>& m, Vec3<F> point) {
  return point_at(point, F(-2.0f) * (dot(m.normal, point) + m.height), m.normal);
}

/// A sphere of radius 0 at the mirror image of a point: with it sample_light_point() draws points that face the image.
template <class F>
TYNDALL_INLINE SpecularSphere<F> seen_by_mirror(const SpecularMirror<F>& m, Vec3<F> point) {
  SpecularSphere<F> b{};
  b.center = mirrored(m, point);
  return b;
}

/// Factor of mirror_worth() where the point does not see the middle of the light in the mirror. It may still see other
/// parts.
inline constexpr float min_mirror_worth = 1e-3f;

/// Estimated contribution, > 0, of pair k of a mirror and a light at a point: light_worth() of the light's mirror
/// image.
template <class F>
TYNDALL_INLINE F mirror_worth(const SpecularView& c, int k, Vec3<F> point) {
  const float* number = c.mirrors + std::ptrdiff_t{numbers_of_mirror} * (c.sphere[k] - c.first_mirror);
  const auto row = [&](std::ptrdiff_t i) {
    return splat<F>(Vec3f{number[3 * i], number[3 * i + 1], number[3 * i + 2]});
  };
  const auto value = [&](int i) { return splat<F>(number[i]); };
  const Vec3<F> light = splat<F>(Vec3f{c.choice.center[0][k], c.choice.center[1][k], c.choice.center[2][k]});
  const F near = dot(row(2), point) + value(mirror_offsets + 2), far = dot(row(2), light) + value(mirror_offsets + 2);
  const F height = max(abs(near) + abs(far), F(1e-30f)), up_to_plane = abs(near) / height;  // fraction of the path
  const Vec3<F> to_light = point_at(light, F(-2.0f) * far, row(2)) - point, at = point_at(point, up_to_plane, to_light);
  const F distance2 = dot(to_light, to_light), reach2 = splat<F>(c.choice.reach2[k]);
  const F blur =
      up_to_plane * sqrt(reach2 * distance2) / height;  // how far from `at` other points of the light may be seen
  auto seen = less(F(0.0f), near * far);
  for (int i = 0; i < 2; ++i) {
    const F place = abs(dot(row(i), at) + value(mirror_offsets + i));
    seen = mask_and(seen, less_equal(place, mul_add(blur, value(mirror_slopes + i), F(1.0f))));
  }
  return splat<F>(c.choice.power[k]) / max(distance2, reach2) * select(seen, F(1.0f), F(min_mirror_worth));
}

/// The path off a mirror between two points.
template <class F>
struct MirrorPath {
  MaskOf<F> found;                ///< the path meets the face, and the points are on one side
  MaskOf<F> behind;               ///< the points are behind the mirror
  Vec3<F> direction, arrive;      ///< unit directions in which the path leaves the near end and arrives at the far end
  F near_distance, far_distance;  ///< distances from each end to the mirror
  F spread;                       ///< area across the path at the far end over solid angle at the near end
};

template <class F>
TYNDALL_INLINE MirrorPath<F> mirror_path(const SpecularMirror<F>& m, Vec3<F> near, Vec3<F> far) {
  const F below = dot(m.normal, near) + m.height, above = dot(m.normal, far) + m.height;
  const Vec3<F> image = mirrored(m, near), offset = far - image;
  const F distance = max(length(offset), F(1e-30f));
  const F up_to_plane = abs(below) / max(abs(below) + abs(above), F(1e-30f));  // fraction of the path
  const Vec3<F> at = point_at(image, up_to_plane, offset);
  MirrorPath<F> w;
  w.behind = less(above, F(0.0f));
  w.arrive = (F(1.0f) / distance) * offset;
  w.direction = point_at(w.arrive, F(-2.0f) * dot(m.normal, w.arrive), m.normal);
  w.near_distance = up_to_plane * distance, w.far_distance = distance - w.near_distance;
  w.spread = distance * distance;
  const F edge = max(abs(dot(m.row[0], at) + m.offset[0]), abs(dot(m.row[1], at) + m.offset[1]));
  w.found = mask_and(less(F(0.0f), below * above), less_equal(edge, F(1.0f)));
  return w;
}

template <class F>
struct SpecularSlab {
  Vec3<F> row[3];           ///< unit vectors along the edges
  F offset[3];              ///< row · p + offset: coordinate of a point p along this edge, from the middle
  F half[3];                ///< half the length of each edge
  F index, medium_density;  ///< refractive index; density of media inside
  IntOf<F> closed;          ///< bit 2 · edge + (0: lower face, 1: upper face): another object touches that face
  IntOf<F> element;         ///< index of the first face among the scene's elements
};

/// Reads a slab. slab: index among the slabs.
template <class F>
TYNDALL_INLINE SpecularSlab<F> load_slab(const SpecularView& c, IntOf<F> slab) {
  const IntOf<F> at = slab * IntOf<F>(numbers_of_slab);
  const auto value = [&](int k) { return gather<F>(c.slabs + k, at); };
  SpecularSlab<F> p;
  for (int k = 0; k < 3; ++k) {
    p.row[k] = {value(3 * k), value(3 * k + 1), value(3 * k + 2)};
    p.offset[k] = value(slab_offsets + k), p.half[k] = value(slab_halves + k);
  }
  p.index = value(slab_index), p.medium_density = value(slab_medium_density), p.closed = to_int(value(slab_closed));
  p.element = lookup<F>(c.outer, c.spheres, slab + IntOf<F>(c.first_slab));
  return p;
}

/// The event sequence of a path at a slab.
template <class F>
struct SlabSequence {
  IntOf<F> across;  ///< the edge at whose end the path enters
  F crossings;      ///< crossings from one of the faces there to the other; 0: reflected off the outside
  F image[2];  ///< reflections at the side faces, for the two edges that follow `across`; negative if the lower face
               ///< comes first
};

/// value[edge] in every lane.
template <class F>
TYNDALL_INLINE F of_edge(const F (&value)[3], IntOf<F> edge) {
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
TYNDALL_INLINE SlabPlace<F> framed(const SpecularSlab<F>& slab, Vec3<F> point, IntOf<F> across) {
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
TYNDALL_INLINE SlabFrame<F> slab_frame(const SpecularSlab<F>& slab, Vec3<F> near, Vec3<F> far, IntOf<F> across) {
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

/// The slope of a path outside: the tangent of its angle to the normal of the faces. Along the faces the path covers
/// slope · reach; growth is the derivative of that product by the slope.
template <class F>
struct SlabSlope {
  F slope, reach, growth;
};

/// Returns reach and growth for a slope. outside, inside: height that the path covers outside and inside of the glass.
template <class F>
TYNDALL_INLINE SlabSlope<F> reach_of(F index, F outside, F inside, F slope) {
  const F n2 = index * index, w2 = mul_add((index - F(1.0f)) * (index + F(1.0f)), slope * slope, n2), w = sqrt(w2);
  return {slope, outside + inside / w, mul_add(inside, n2 / (w2 * w), outside)};
}

/// The slope of a path that covers the distance `across` along the faces, by Newton's method. The distance is a concave
/// function of the slope, so that each step from below falls short and none overshoots.
template <class F>
TYNDALL_INLINE F find_slope(F index, F outside, F inside, F across, int steps) {
  const F n2 = index * index, more = (index - F(1.0f)) * (index + F(1.0f));
  const F maximum = inside / sqrt(more);  // largest distance inside
  F slope = max(across / (outside + inside / index), (across - maximum) / outside);
  for (int i = 0; i < steps; ++i) {
    const F w = F(1.0f) / sqrt(mul_add(more, slope * slope, n2)), t = slope * w;
    slope = (across - inside * more * (t * t * t)) / mul_add(inside * n2, w * w * w, outside);
  }
  return slope;
}

/// A path through a slab.
template <class F>
struct SlabPath {
  MaskOf<F> found;                ///< the path meets the faces
  Vec3<F> direction, arrive;      ///< unit directions in which the path leaves the near end and arrives at the far end
  F near_distance, far_distance;  ///< distances from each end to the slab
  F within;                       ///< length of the path in the glass
  F throughput;                   ///< fraction of light that the faces send along this path
  F spread;                       ///< area across the path at the far end over solid angle at the near end
};

/// Sets the throughput and the spread of a path from its slope.
template <class F>
TYNDALL_INLINE void follow_slope(const SlabFrame<F>& s, const SlabSequence<F>& sequence, const SlabSlope<F>& at,
                                 SlabPath<F>& path) {
  const F stretch2 = mul_add(at.slope, at.slope, F(1.0f)), cosine = F(1.0f) / sqrt(stretch2);
  const F reflected = fresnel(cosine, s.index), passed = F(1.0f) - reflected;
  path.throughput = select(equal(sequence.crossings, F(0.0f)), reflected,
                           passed * passed * whole_power(reflected, max(sequence.crossings - F(1.0f), F(0.0f))));
  path.spread = at.reach * at.growth * stretch2;
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
TYNDALL_INLINE SlabPath<F> slab_path(const SpecularSlab<F>& slab, const SlabFrame<F>& s,
                                     const SlabSequence<F>& sequence) {
  constexpr int steps = std::is_same_v<F, double> ? 40 : 6;
  const F outside = max(s.near_gap + s.far_gap, F(1e-30f)), inside = F(2.0f) * sequence.crossings * s.half.height;
  const F x = to_image(s, 0, sequence.image[0]), y = to_image(s, 1, sequence.image[1]);
  const F slope = find_slope(s.index, outside, inside, sqrt(mul_add(x, x, y * y)), steps);
  const SlabSlope<F> at = reach_of(s.index, outside, inside, slope);
  const F gone[2] = {x / at.reach, y / at.reach};  // along each edge for each unit of height outside
  SlabPath<F> path;
  follow_slope(s, sequence, at, path);
  path.found = meets_faces(s, sequence, gone, F(0.0f));
  const F stretch = sqrt(mul_add(slope, slope, F(1.0f))), cosine = F(1.0f) / stretch;
  path.near_distance = s.near_gap * stretch, path.far_distance = s.far_gap * stretch;
  const F sine = slope * cosine / s.index;
  path.within = inside / sqrt(max(F(1.0f) - sine * sine, F(1e-12f)));
  const IntOf<F> edge[3] = {next_edge<F>(sequence.across), next_edge<F>(next_edge<F>(sequence.across)),
                            sequence.across};
  const F up = copy_sign(cosine, s.near.height);
  const F leave[3] = {cosine * gone[0], cosine * gone[1], -up};
  const F arrive[3] = {parity_sign(sequence.image[0]) * leave[0], parity_sign(sequence.image[1]) * leave[1],
                       select(s.same, up, -up)};
  path.direction = path.arrive = zero3<F>();
  for (int k = 0; k < 3; ++k) {
    const Vec3<F> row{of_edge<F>({slab.row[0].x, slab.row[1].x, slab.row[2].x}, edge[k]),
                      of_edge<F>({slab.row[0].y, slab.row[1].y, slab.row[2].y}, edge[k]),
                      of_edge<F>({slab.row[0].z, slab.row[1].z, slab.row[2].z}, edge[k])};
    path.direction = point_at(path.direction, leave[k], row), path.arrive = point_at(path.arrive, arrive[k], row);
  }
  return path;
}

}  // namespace tyndall

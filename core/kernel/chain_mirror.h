#pragma once
#include "core/kernel/chain_lamp.h"

/// Chains off flat mirrors: quads, and faces of boxes, of metal without fuzz. What a mirror shows of a lamp is the
/// lamp's image behind it, so there is one such way between two points on the same side, if it meets the face.
namespace tyndall {

template <class F>
struct ChainMirror {
  Vec3<F> row[2], normal;  ///< row · p + offset runs from -1 to 1 across the face at p
  F offset[2], height;     ///< normal · p + height: distance of p from the mirror's plane, negative behind it
};

/// mirror: its index among the flat mirrors.
template <class F>
TYNDALL_INLINE ChainMirror<F> load_mirror(const ChainView& c, IntOf<F> mirror) {
  const IntOf<F> at = mirror * IntOf<F>(numbers_of_mirror);
  const auto value = [&](int k) { return gather<F>(c.mirrors + k, at); };
  const auto row = [&](int k) { return Vec3<F>{value(3 * k), value(3 * k + 1), value(3 * k + 2)}; };
  return {{row(0), row(1)}, row(2), {value(mirror_offsets), value(mirror_offsets + 1)}, value(mirror_offsets + 2)};
}

/// The image of a point.
template <class F>
TYNDALL_INLINE Vec3<F> mirrored(const ChainMirror<F>& m, Vec3<F> point) {
  return along(point, F(-2.0f) * (dot(m.normal, point) + m.height), m.normal);
}

/// What takes the place of the ball where points of a lamp are drawn: those that see the point's image.
template <class F>
TYNDALL_INLINE ChainBall<F> seen_by_mirror(const ChainMirror<F>& m, Vec3<F> point) {
  ChainBall<F> b{};
  b.center = mirrored(m, point);
  return b;
}

/// Of what a lamp is worth to a point by a mirror, so much is left where the point does not see the middle of the lamp
/// in it: it may see other parts.
inline constexpr float least_mirror_worth = 1e-3f;

/// What pair k of a ball or mirror and a lamp is worth at a point, > 0. See light_worth(); by a mirror the lamp is
/// where its image is.
template <class F>
TYNDALL_INLINE F light_worth(const ChainView& c, int k, Vec3<F> point) {
  const int mirror = c.ball[k] - c.first_mirror;
  if (mirror < 0) return light_worth(c.choice, k, point);
  const float* number = c.mirrors + std::ptrdiff_t{numbers_of_mirror} * mirror;
  const auto row = [&](std::ptrdiff_t i) {
    return splat<F>(Vec3f{number[3 * i], number[3 * i + 1], number[3 * i + 2]});
  };
  const auto value = [&](int i) { return splat<F>(number[i]); };
  const Vec3<F> lamp = splat<F>(Vec3f{c.choice.center[0][k], c.choice.center[1][k], c.choice.center[2][k]});
  const F near = dot(row(2), point) + value(mirror_offsets + 2), far = dot(row(2), lamp) + value(mirror_offsets + 2);
  const F height = max(abs(near) + abs(far), F(1e-30f)), share = abs(near) / height;  // of the way, up to the plane
  const Vec3<F> way = along(lamp, F(-2.0f) * far, row(2)) - point, at = along(point, share, way);
  const F distance2 = dot(way, way), reach2 = splat<F>(c.choice.reach2[k]);
  const F blur = share * sqrt(reach2 * distance2) / height;  // how far from `at` other points of the lamp may be seen
  auto seen = less(F(0.0f), near * far);
  for (int i = 0; i < 2; ++i) {
    const F place = abs(dot(row(i), at) + value(mirror_offsets + i));
    seen = mask_and(seen, less_equal(place, mul_add(blur, value(mirror_slopes + i), F(1.0f))));
  }
  return splat<F>(c.choice.power[k]) / max(distance2, reach2) * select(seen, F(1.0f), F(least_mirror_worth));
}

/// The way off a mirror between two points.
template <class F>
struct MirrorWay {
  MaskOf<F> found;            ///< it meets the face, and the points are on one side
  MaskOf<F> behind;           ///< they are behind the mirror
  Vec3<F> direction, arrive;  ///< unit: in which a path leaves the near end, and in which it arrives at the far one
  F near_way, far_way;        ///< distances from each end to the mirror
  F spread;  ///< area across the way at the far end, over the solid angle that it fills at the near one
};

template <class F>
TYNDALL_INLINE MirrorWay<F> mirror_way(const ChainMirror<F>& m, Vec3<F> near, Vec3<F> far) {
  const F below = dot(m.normal, near) + m.height, above = dot(m.normal, far) + m.height;
  const Vec3<F> image = mirrored(m, near), way = far - image;
  const F distance = max(length(way), F(1e-30f)), share = abs(below) / max(abs(below) + abs(above), F(1e-30f));
  const Vec3<F> at = along(image, share, way);
  MirrorWay<F> w;
  w.behind = less(above, F(0.0f));
  w.arrive = (F(1.0f) / distance) * way;
  w.direction = along(w.arrive, F(-2.0f) * dot(m.normal, w.arrive), m.normal);
  w.near_way = share * distance, w.far_way = distance - w.near_way;
  w.spread = distance * distance;
  const F edge = max(abs(dot(m.row[0], at) + m.offset[0]), abs(dot(m.row[1], at) + m.offset[1]));
  w.found = mask_and(less(F(0.0f), below * above), less_equal(edge, F(1.0f)));
  return w;
}

}  // namespace tyndall

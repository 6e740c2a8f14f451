#pragma once
#include "core/base/ray.h"
#include "core/kernel/scene_view.h"
#include "core/media/medium.h"
#include "core/shapes/box.h"
#include "core/shapes/sphere.h"

/// Flights through media: where along its ray a path scatters before it meets a surface.
namespace tyndall {

/// Where a path scatters within a medium, if it does.
template <class F>
struct MediumEvent {
  MaskOf<F> happens;
  Vec3<F> point;  ///< the ray's origin where nothing happens
  IntOf<F> medium;
  F density;      ///< of the medium: its mean number of events per unit length
  F begin, far;   ///< distances between which the ray is within the medium's boundary
  IntOf<F> from;  ///< Ray::from of a start within the medium
  Vec3<F> albedo;
  IntOf<F> texture;
  F g;
};

/// No event in any lane.
template <class F>
TYNDALL_INLINE MediumEvent<F> no_event(const Ray<F>& ray) {
  MediumEvent<F> none{};
  none.happens = less(F(1.0f), F(0.0f));
  none.point = ray.origin;
  none.medium = none.texture = IntOf<F>(-1);
  none.from = IntOf<F>(from_nowhere);
  return none;
}

/// The distances between which a line is inside a medium's boundary. from: see Ray.
template <class F>
TYNDALL_INLINE Interval<F> medium_interval(const MediumColumns& m, Vec3<F> origin, Vec3<F> direction, IntOf<F> from) {
  const Start<F> start = start_on<F>(from, m.first, m.count);
  if (m.box) {
    const BoxSlabs<F> slabs = box_slabs(m.map, origin, direction);
    if (!any(start.here)) return slabs.inside;
    const Interval<F> line = leave_box(slabs.inside, start);
    const auto within =
        mask_and(start.here, equal(from & IntOf<F>(3), IntOf<F>(static_cast<std::int32_t>(Side::within))));
    return {line.near, select(within, leave_from_within(slabs), line.far), line.hit};
  }
  const Vec3<F> to_center = splat<F>(m.center) - origin;
  const Interval<F> line = sphere_interval(to_center, splat<F>(m.radius), direction);
  return any(start.here) ? leave_sphere(line, to_center, direction, from, start) : line;
}

/// The point at which a ray enters a medium; its origin if it starts inside. After a long way the point is rounded to
/// the spacing of floats. Where that could be more than a thousandth of a mean free path, the point is computed a
/// second time from the first result, which is close to it.
template <class F>
TYNDALL_INLINE Vec3<F> enter_medium(const MediumColumns& m, const Ray<F>& ray, const Interval<F>& inside,
                                    MaskOf<F> lanes) {
  const F begin = max(inside.near, F(0.0f));
  const Vec3<F> point = along(ray.origin, select(lanes, begin, F(0.0f)), ray.direction);
  const auto dense = mask_and(lanes, less(F(0x1p14f), splat<F>(m.density) * inside.far));
  if (!any(dense)) return point;
  const Start<F> start = start_on<F>(ray.from, m.first, m.count);
  const auto on_surface = mask_and(start.here, equal(ray.from & IntOf<F>(3), IntOf<F>(1)));
  const auto inexact = mask_and(dense, mask_or(on_surface, less(F(0.0f), begin)));
  if (!any(inexact)) return point;
  const Interval<F> again = medium_interval(m, point, ray.direction, IntOf<F>(from_nowhere));
  return along(point, select(mask_and(inexact, again.hit), again.near, F(0.0f)), ray.direction);
}

/// Draws where a path scatters in media before it meets a surface. Each medium has a free flight of its own, and the
/// shortest counts; this is right where media overlap, too, because their densities add. nearest: on entry the distance
/// to the surface; shortened to the event where there is one.
template <class F>
TYNDALL_INLINE MediumEvent<F> fly_through_media(const auto& s, const Ray<F>& ray, const Dice<F>& dice, MaskOf<F> active,
                                                F& nearest) {
  const F infinity = F(__builtin_inff());
  MediumEvent<F> event = no_event(ray);
  for (int k = 0; k < s.medium_count; ++k) {
    const MediumColumns& m = s.media[k];
    const Interval<F> inside = medium_interval(m, ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, nearest);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (!any(crosses)) continue;
    const F flight = free_flight(splat<F>(m.density), dice.open(dimension::free_flight, static_cast<std::uint32_t>(k)));
    const F t = begin + flight;
    const auto here = mask_and(mask_and(crosses, less(t, end)), less(t, infinity));
    nearest = select(here, t, nearest);
    event.happens = mask_or(event.happens, here);
    const Vec3<F> entry = enter_medium(m, ray, inside, here);
    event.point = select(here, along(entry, flight, ray.direction), event.point);
    event.medium = select(here, IntOf<F>(k), event.medium);
    event.density = select(here, splat<F>(m.density), event.density);
    event.begin = select(here, begin, event.begin), event.far = select(here, inside.far, event.far);
    event.from = select(here, IntOf<F>(4 * m.first + static_cast<std::int32_t>(Side::within)), event.from);
    event.albedo = select(here, splat<F>(m.albedo), event.albedo);
    if (s.has_textures()) event.texture = select(here, IntOf<F>(m.texture), event.texture);
    if (s.needs.phase_functions) event.g = select(here, splat<F>(m.g), event.g);
  }
  return event;
}

/// Share of the light, in [0, 1], that passes all media on the way to `distance`.
template <class F>
TYNDALL_INLINE F pass_media(const SceneView& s, const Ray<F>& ray, F distance, MaskOf<F> active) {
  F depth = F(0.0f);
  for (int k = 0; k < s.medium_count; ++k) {
    const Interval<F> inside = medium_interval(s.media[k], ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, distance);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (any(crosses)) depth = select(crosses, mul_add(end - begin, splat<F>(s.media[k].density), depth), depth);
  }
  return any(less(F(0.0f), depth)) ? transmittance(depth) : F(1.0f);
}

}  // namespace tyndall

#pragma once
#include "core/base/ray.h"
#include "core/base/sampling.h"
#include "core/shapes/sphere.h"
#include "core/trace/light_choice.h"
#include "core/trace/spherical_triangle.h"

/// Samples points of lights as seen from a point, and gives the pdf of the direction, per steradian, times the
/// probability of choosing the light (light_choice.h). This pdf depends only on the point and the light, so that a ray
/// that hits a light by BSDF sampling can be weighed against the sample that would have chosen the same direction.
namespace tyndall {

/// A rectangle as seen from a point: its sides in a frame along its edges with the point at the origin, and its solid
/// angle. After C. Ureña, M. Fajardo, A. King, An Area-Preserving Parametrization for Spherical Rectangles, EGSR 2013.
/// Each corner (x, y, z) at distance d is written as a complex number, z d + i x y. The angle of their product (two of
/// the four conjugated) is the solid angle, so that one arc tangent is enough.
template <class F>
struct SphericalRectangle {
  F x0, y0, x1, y1, z;     ///< in units of `scale`; z: distance from the rectangle's plane, >= 0
  F scale;                 ///< the largest of these coordinates, in scene units
  F solid_angle;           ///< 0: too small, too flat or too wide for these formulas; then the area is sampled
  F angle_cos, angle_sin;  ///< cosine and sine of the angle of conj(c01) c00, the corners (x0, y1) and (x0, y0)
};

template <class F>
struct Complex {
  F re, im;
};
template <class F>
TYNDALL_INLINE Complex<F> times(Complex<F> a, Complex<F> b) {
  return {a.re * b.re - a.im * b.im, mul_add(a.re, b.im, a.im * b.re)};
}
template <class F>
TYNDALL_INLINE Complex<F> conjugate(Complex<F> a) {
  return {a.re, -a.im};
}

/// A corner (x, y) of a rectangle at distance z from the origin, as the complex number z r + i x y: see
/// SphericalRectangle.
template <class F>
TYNDALL_INLINE Complex<F> corner_at(F x, F y, F z) {
  return {z * sqrt(mul_add(x, x, mul_add(y, y, z * z))), x * y};
}

template <class F>
TYNDALL_INLINE SphericalRectangle<F> rectangle_from(const LightColumns<F>& light, Vec3<F> point) {
  const Vec3<F> to_light = light.corner - point;
  SphericalRectangle<F> r;
  const F x = dot(to_light, light.edge_u), y = dot(to_light, light.edge_v), z = abs(dot(to_light, light.normal));
  const F largest =
      max(max(max(abs(x), abs(x + light.length_u)), max(abs(y), abs(y + light.length_v))), max(z, F(1e-30f)));
  r.scale = largest;
  const F down = F(1.0f) / largest;
  r.x0 = x * down, r.y0 = y * down, r.z = z * down;
  r.x1 = (x + light.length_u) * down, r.y1 = (y + light.length_v) * down;
  const Complex<F> q = times(conjugate(corner_at(r.x0, r.y1, r.z)), corner_at(r.x0, r.y0, r.z));
  const Complex<F> all = times(times(corner_at(r.x1, r.y1, r.z), conjugate(corner_at(r.x1, r.y0, r.z))), q);
  const F angle = atan2(all.im, all.re);
  const F solid_angle = select(less(angle, F(0.0f)), angle + F(static_cast<float>(2 * pi)), angle);
  const auto good = mask_and(mask_and(less(F(2e-3f), solid_angle), less(solid_angle, F(6.28f))), less(F(1e-4f), r.z));
  r.solid_angle = select(mask_and(good, equal(light.kind, IntOf<F>(Lights::rectangle))), solid_angle, F(0.0f));
  const F inverse = F(1.0f) / sqrt(max(mul_add(q.re, q.re, q.im * q.im), F(1e-37f)));
  r.angle_cos = q.re * inverse, r.angle_sin = q.im * inverse;
  return r;
}

/// Point of a rectangle drawn uniformly in solid angle: (x, y) in the rectangle's frame, in units of its scale.
template <class F>
TYNDALL_INLINE Pair<F> on_spherical_rectangle(const SphericalRectangle<F>& r, Pair<F> u) {
  const SinCos<F> part = sin_cos_2pi(min(u.x * r.solid_angle * F(static_cast<float>(0.5 / pi)), F(0.9999999f)));
  // The angle is u S + π - arg q.
  const F sine = mul_add(r.angle_sin, part.cos, -(r.angle_cos * part.sin));
  const F cosine = -mul_add(r.angle_cos, part.cos, r.angle_sin * part.sin);
  const F z2 = r.z * r.z;
  const F b0 = -r.y0 / sqrt(mul_add(r.y0, r.y0, z2)), b1 = r.y1 / sqrt(mul_add(r.y1, r.y1, z2));
  const F safe = select(less(abs(sine), F(1e-20f)), F(1e-20f), sine);
  const F f = mul_add(cosine, b0, -b1) / safe;
  const F c = min(max(copy_sign(F(1.0f), f) / sqrt(mul_add(f, f, b0 * b0)), F(-1.0f)), F(1.0f));
  const F x = min(max(c * r.z / sqrt(max(neg_mul_add(c, c, F(1.0f)), F(1e-14f))), r.x0), r.x1);
  const F d2 = mul_add(x, x, z2);
  const F h0 = r.y0 / sqrt(mul_add(r.y0, r.y0, d2)), h1 = r.y1 / sqrt(mul_add(r.y1, r.y1, d2));
  const F h = mul_add(u.y, h1 - h0, h0);
  const F y = h * sqrt(d2) / sqrt(max(neg_mul_add(h, h, F(1.0f)), F(1e-14f)));
  return {x, min(max(y, r.y0), r.y1)};
}

/// A sphere as seen from a point: the directions to it fill a cone, in which they are drawn uniformly.
/// P. Shirley, C. Wang, K. Zimmerman, Monte Carlo Techniques for Direct Lighting Calculations, ACM TOG 15(1), 1996.
template <class F>
struct SphericalCap {
  Vec3<F> axis;     ///< unit, towards the centre
  F one_minus_cos;  ///< 1 - cos of the cone's half angle; 2: the point is inside, and every direction meets the sphere
  F pdf;            ///< of each direction, per steradian
};

template <class F>
TYNDALL_INLINE SphericalCap<F> cap_from(Vec3<F> to_center, F radius) {
  const F d2 = dot(to_center, to_center), r2 = radius * radius;
  const auto inside = less_equal(d2, r2);
  const F sine2 = min(r2 / max(d2, F(1e-37f)), F(1.0f));
  // 1 - cos without cancellation: sin² / (1 + cos).
  const F narrow = sine2 / (F(1.0f) + sqrt(max(F(1.0f) - sine2, F(0.0f))));
  const F part = select(inside, F(2.0f), narrow);
  const F scale = F(1.0f) / sqrt(max(d2, F(1e-37f)));
  const Vec3<F> anywhere{F(0.0f), F(0.0f), F(1.0f)};
  return {select(less(F(0.0f), d2), scale * to_center, anywhere), part, F(static_cast<float>(0.5 / pi)) / part};
}

/// Draws a direction in the cone by u in [0, 1)².
template <class F>
TYNDALL_INLINE Vec3<F> in_cap(const SphericalCap<F>& cap, Pair<F> u) {
  const F x = u.x * cap.one_minus_cos;  // 1 - cos of the angle from the axis
  const F sine = sqrt(max(x * (F(2.0f) - x), F(0.0f)));
  const Basis<F> b = basis_around(cap.axis);
  const SinCos<F> a = sin_cos_2pi(u.y);
  return point_at(point_at((F(1.0f) - x) * cap.axis, sine * a.cos, b.s), sine * a.sin, b.t);
}

template <class F>
TYNDALL_INLINE Vec3<F> sphere_light_center(const LightColumns<F>& light, F time) {
  return point_at(light.corner, time, light.edge_u);
}

/// A sampled direction to a light.
template <class F>
struct LightSample {
  Vec3<F> direction;  ///< unit
  F distance;
  F pdf;  ///< per steradian, without the probability of choosing the light; 0: no light comes from there
};

/// k: the light's index; light: its columns.
template <class F>
TYNDALL_INLINE LightSample<F> sample_flat(const auto& s, IntOf<F> k, const LightColumns<F>& light, Vec3<F> point,
                                          Pair<F> u) {
  const SphericalRectangle<F> r = rectangle_from(light, point);
  F solid_angle = r.solid_angle;
  auto by_area = equal(solid_angle, F(0.0f));
  const Pair<F> drawn = on_flat_light(s, k, light.kind, u);
  Vec3<F> to_light =
      point_at(point_at(light.corner, drawn.x * light.length_u, light.edge_u), drawn.y * light.length_v, light.edge_v) -
      point;
  if (!all(by_area)) {
    const Pair<F> at = on_spherical_rectangle(r, u);
    const F side = copy_sign(F(1.0f), dot(light.corner - point, light.normal));
    const Vec3<F> local = point_at(point_at(at.x * light.edge_u, at.y, light.edge_v), side * r.z, light.normal);
    to_light = select(by_area, to_light, r.scale * local);
  }
  if (s.has_outlined_lights()) {
    const DrawnBySolidAngle<F> triangle = draw_on_triangle(light, point, u);
    const auto by_angle = less(F(0.0f), triangle.solid_angle);
    solid_angle = select(by_angle, triangle.solid_angle, solid_angle);
    to_light = select(by_angle, triangle.to_light, to_light);
    by_area = equal(solid_angle, F(0.0f));
  }
  const F d2 = max(dot(to_light, to_light), F(1e-37f)), inverse = F(1.0f) / sqrt(d2);
  const Vec3<F> direction = inverse * to_light;
  const F cosine = abs(dot(direction, light.normal));
  const F area_pdf = select(less(F(0.0f), cosine), d2 / max(cosine * light.area, F(1e-37f)), F(0.0f));
  return {direction, d2 * inverse, select(by_area, area_pdf, F(1.0f) / solid_angle)};
}

template <class F>
TYNDALL_INLINE LightSample<F> sample_sphere_light(const LightColumns<F>& light, Vec3<F> point, F time, Pair<F> u) {
  const Vec3<F> to_center = sphere_light_center(light, time) - point;
  const SphericalCap<F> cap = cap_from(to_center, light.length_u);
  const Vec3<F> direction = in_cap(cap, u);
  // The direction was drawn within the cone. If rounding makes it miss the sphere, it counts as one that grazes it.
  const F middle = dot(to_center, direction);
  const Vec3<F> across = point_at(to_center, -middle, direction);
  const F half = sqrt(max(mul_add(light.length_u, light.length_u, -dot(across, across)), F(0.0f)));
  const F near = middle - half;
  return {direction, select(less(F(0.0f), near), near, middle + half), cap.pdf};
}

template <class F>
TYNDALL_INLINE LightSample<F> sample_light(const auto& s, IntOf<F> light, Vec3<F> point, F time, Pair<F> u) {
  const LightColumns<F> columns = load_light<F>(s.lights, light);
  const auto round = equal(columns.kind, IntOf<F>(Lights::sphere));
  LightSample<F> sample{{F(0.0f), F(0.0f), F(1.0f)}, F(0.0f), F(0.0f)};
  if (!all(round)) sample = sample_flat(s, light, columns, point, u);
  if (any(round)) {
    const LightSample<F> sphere = sample_sphere_light(columns, point, time, u);
    sample = {select(round, sphere.direction, sample.direction), select(round, sphere.distance, sample.distance),
              select(round, sphere.pdf, sample.pdf)};
  }
  return sample;
}

/// Pdf, per steradian, with which sample_light() gives `direction`, which hits `light` at `distance`, times the
/// probability with which choose_light() takes this light.
template <class F>
TYNDALL_INLINE F light_pdf(const auto& s, IntOf<F> light, Vec3<F> point, F time, Vec3<F> direction, F distance) {
  const LightColumns<F> columns = load_light<F>(s.lights, light);
  const auto round = equal(columns.kind, IntOf<F>(Lights::sphere));
  F pdf = F(0.0f);
  if (!all(round)) {
    const SphericalRectangle<F> r = rectangle_from(columns, point);
    const F cosine = abs(dot(direction, columns.normal));
    const F by_area = distance * distance / max(cosine * columns.area, F(1e-37f));
    const F solid_angle =
        s.has_outlined_lights() ? r.solid_angle + triangle_solid_angle(columns, point) : r.solid_angle;
    pdf = select(less(F(0.0f), solid_angle), F(1.0f) / solid_angle, by_area);
  }
  if (any(round)) pdf = select(round, cap_from(sphere_light_center(columns, time) - point, columns.length_u).pdf, pdf);
  return pdf * choice_probability(s.lights, point, light);
}

}  // namespace tyndall

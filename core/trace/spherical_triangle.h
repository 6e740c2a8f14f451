#pragma once
#include "core/base/math.h"
#include "core/trace/light_choice.h"

/// Samples lights that are triangles uniformly in the solid angle in which a point sees them.
namespace tyndall {

/// A triangle as seen from a point: unit vectors to its corners, and its solid angle by A. Van Oosterom, J. Strackee,
/// The Solid Angle of a Plane Triangle, IEEE Transactions on Biomedical Engineering 30(2), 1983.
template <class F>
struct SphericalTriangle {
  Vec3<F> a, b, c;
  F solid_angle;           ///< 0: no triangle, or too small, too flat or too wide; then the area is sampled
  F angle_cos, angle_sin;  ///< of the angle at a, on the sphere
};

template <class F>
TYNDALL_INLINE SphericalTriangle<F> triangle_from(const LightColumns<F>& light, Vec3<F> point) {
  const Vec3<F> to_a = light.corner - point, to_b = point_at(to_a, light.length_u, light.edge_u),
                to_c = point_at(to_a, light.length_v, light.edge_v);
  const auto inverse_length = [](Vec3<F> v) __attribute__((always_inline)) {
    return F(1.0f) / sqrt(max(dot(v, v), F(1e-37f)));
  };
  const F height = abs(dot(to_a, light.normal));
  const F at_a = inverse_length(to_a), at_b = inverse_length(to_b), at_c = inverse_length(to_c);
  SphericalTriangle<F> s{at_a * to_a, at_b * to_b, at_c * to_c, F(0.0f), F(1.0f), F(0.0f)};
  const F product = (F(2.0f) * light.area * at_a * at_b) * (height * at_c);  // a · (b × c)
  const F sum = F(1.0f) + dot(s.a, s.b) + dot(s.b, s.c) + dot(s.c, s.a);
  const F solid_angle = F(2.0f) * atan2(product, sum);
  const Vec3<F> across_b = cross(s.a, s.b), across_c = cross(s.a, s.c);
  const F inverse = inverse_length(across_b) * inverse_length(across_c);
  s.angle_cos = dot(across_b, across_c) * inverse, s.angle_sin = product * inverse;
  const auto good =
      mask_and(mask_and(less(F(2e-3f), solid_angle), less(solid_angle, F(6.2f))),
               mask_and(less(F(1e-4f), height * max(max(at_a, at_b), at_c)), less(F(1e-2f), s.angle_sin)));
  s.solid_angle = select(mask_and(good, equal(light.kind, IntOf<F>(Lights::triangle))), solid_angle, F(0.0f));
  return s;
}

/// Direction drawn uniformly in the solid angle of a triangle. J. Arvo, Stratified Sampling of Spherical Triangles,
/// SIGGRAPH 1995, with differences of cosines written as squares of sines.
template <class F>
TYNDALL_INLINE Vec3<F> on_spherical_triangle(const SphericalTriangle<F>& s, Pair<F> u) {
  const auto part_across = [](Vec3<F> v, Vec3<F> axis) __attribute__((always_inline)) {
    const Vec3<F> rest = point_at(v, -dot(v, axis), axis);
    return (F(1.0f) / sqrt(max(dot(rest, rest), F(1e-37f)))) * rest;
  };
  // The triangle a, b, d with d on the arc from a to c has the fraction u.x of the area.
  const SinCos<F> half = sin_cos_2pi(u.x * s.solid_angle * F(static_cast<float>(0.25 / pi)));
  const F lost = F(2.0f) * half.sin * half.sin, sine = F(2.0f) * half.sin * half.cos;  // 1 - cos and sin of its area
  const Vec3<F> chord = s.a - s.b;
  const F p = s.angle_cos, q = s.angle_sin, apart = F(0.5f) * dot(chord, chord);  // 1 - cos of the arc from a to b
  const F x = mul_add(q, sine, -(p * lost)), y = mul_add(q, lost - apart, p * sine);
  const F rotated_sin = mul_add(p, sine, -(q * (F(1.0f) - lost))), rotated_cos = mul_add(p, F(1.0f) - lost, q * sine);
  const F above = mul_add(mul_add(y, rotated_cos, -(x * rotated_sin)), p, -y);
  const F below = mul_add(y, rotated_sin, x * rotated_cos) * q;
  const F safe = select(less(abs(below), F(1e-30f)), F(1e-30f), below);
  const F cosine = select(less(abs(below), F(1e-30f)), F(1.0f), min(max(above / safe, F(-1.0f)), F(1.0f)));
  const F across = sqrt(max(neg_mul_add(cosine, cosine, F(1.0f)), F(0.0f)));
  const Vec3<F> d = point_at(cosine * s.a, across, part_across(s.c, s.a));
  const Vec3<F> arc = d - s.b;
  const F away = u.y * F(0.5f) * dot(arc, arc);  // 1 - cos of the way from b towards d
  return point_at((F(1.0f) - away) * s.b, sqrt(max(away * (F(2.0f) - away), F(0.0f))), part_across(d, s.b));
}

/// A flat light's solid angle, where it is sampled by it, and the vector to the drawn point.
template <class F>
struct DrawnBySolidAngle {
  F solid_angle;  ///< 0: it is not
  Vec3<F> to_light;
};

// Not inlined, and by value: see call_closest().
template <class F>
[[gnu::noinline]] static DrawnBySolidAngle<F> draw_on_triangle(LightColumns<F> light, Vec3<F> point, Pair<F> u) {
  const SphericalTriangle<F> s = triangle_from(light, point);
  const Vec3<F> direction = on_spherical_triangle(s, u);
  const F distance = abs(dot(light.corner - point, light.normal)) / max(abs(dot(direction, light.normal)), F(1e-20f));
  return {s.solid_angle, distance * direction};
}
template <class F>
[[gnu::noinline]] static F triangle_solid_angle(LightColumns<F> light, Vec3<F> point) {
  return triangle_from(light, point).solid_angle;
}

}  // namespace tyndall

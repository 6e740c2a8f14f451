#pragma once
#include "core/specular/specular_path.h"
#include "core/trace/sky.h"

/// The sun of a picture of the sky as specular paths at spheres know it.
///
/// The sun has no distance, but the solutions for spheres need a point to which paths lead. So each sphere looks at the
/// sun through a window: a square at sun_distance times its radius, across the direction of the sun. A ray from the
/// sphere to the sky passes through one point of the window's plane; the window's points are drawn uniformly, and the
/// radiance is that of the sky in the direction in which the ray passes. Nothing is approximated: the window only
/// numbers the directions, and light that passes beside it is left to the other strategies.
namespace tyndall {

/// In radii of the sphere. Rays to one point of the window differ by up to its inverse in their direction; with longer
/// distances rounding would move the points where paths leave the sphere.
inline constexpr float sun_distance = 256;

/// The window of a sphere, as a light: a rectangle.
template <class F>
TYNDALL_INLINE LightColumns<F> sun_window(const SkyColumns& sky, const SpecularSphere<F>& b) {
  const F distance = F(sun_distance) * b.radius;
  const F half = distance * splat<F>(sky.sun_tangent + 1 / sun_distance);
  LightColumns<F> w;
  w.kind = IntOf<F>(Lights::rectangle);
  w.edge_u = splat<F>(sky.sun_edge_u), w.edge_v = splat<F>(sky.sun_edge_v), w.normal = splat<F>(sky.sun_axis);
  w.corner = point_at(point_at(point_at(b.center, distance, w.normal), -half, w.edge_u), -half, w.edge_v);
  w.length_u = half + half, w.length_v = w.length_u;
  w.area = w.length_u * w.length_u;
  return w;
}

/// The columns of lights, or of the sun's window where `light` is -1.
template <class F>
TYNDALL_INLINE LightColumns<F> load_light_or_sun(const auto& s, IntOf<F> light, const SpecularSphere<F>& b) {
  if (!s.has_sun_paths()) return load_light<F>(s.lights, light);
  const LightColumns<F> sun = sun_window(s.sky, b);
  const auto far = is_sky<F>(light);
  if (s.lights.count() == 0 || all(far)) return sun;
  using L = LightColumns<F>;
  L light_or_sun = load_light<F>(s.lights, select(far, IntOf<F>(0), light));
  put<F>(far, sun, light_or_sun, &L::kind, &L::corner, &L::edge_u, &L::edge_v, &L::normal, &L::length_u, &L::length_v,
         &L::area);
  return light_or_sun;
}

}  // namespace tyndall

#pragma once
#include "core/base/sampling.h"
#include "core/shapes/outline.h"
#include "core/trace/scene_view.h"

/// The lights of a scene as lanes read them, each lane another one.
namespace tyndall {

/// One light per lane, read from the columns of Lights. With one light in the scene they are read once for all lanes.
template <class F>
struct LightColumns {
  IntOf<F> kind;
  Vec3<F> corner, edge_u, edge_v, normal;
  F length_u, length_v, area;
};

/// Value of a column of lights in each lane.
template <class F>
TYNDALL_INLINE F light_value(const LightView& l, const float* column, IntOf<F> k) {
  return l.count == 1 ? splat<F>(column[0]) : lookup<F>(column, l.count, k);
}

template <class F>
TYNDALL_INLINE Vec3<F> light_vector(const LightView& l, const float* const* columns, IntOf<F> k) {
  return {light_value<F>(l, columns[0], k), light_value<F>(l, columns[1], k), light_value<F>(l, columns[2], k)};
}

template <class F>
TYNDALL_INLINE LightColumns<F> load_light(const LightView& l, IntOf<F> k) {
  return {l.count == 1 ? IntOf<F>(l.kind[0]) : lookup<F>(l.kind, l.count, k),
          light_vector<F>(l, l.corner, k),
          light_vector<F>(l, l.edge_u, k),
          light_vector<F>(l, l.edge_v, k),
          light_vector<F>(l, l.normal, k),
          light_value<F>(l, l.length_u, k),
          light_value<F>(l, l.length_v, k),
          light_value<F>(l, l.area, k)};
}

/// Where u in [0, 1)² lies on the flat light k, as fractions of its edges, uniformly by area. kind: of the light.
template <class F>
TYNDALL_INLINE Pair<F> on_flat_light(const auto& s, IntOf<F> k, IntOf<F> kind, Pair<F> u) {
  if (!s.has_outlined_lights()) return u;
  const auto triangle = equal(kind, IntOf<F>(Lights::triangle)), ring = equal(kind, IntOf<F>(Lights::ring));
  const Pair<F> folded = in_triangle(u), round = in_ring(light_value<F>(s.lights, s.lights.inner, k), u);
  return {select(triangle, folded.x, select(ring, round.x, u.x)),
          select(triangle, folded.y, select(ring, round.y, u.y))};
}

}  // namespace tyndall

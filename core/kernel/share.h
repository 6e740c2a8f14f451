#pragma once
#include "core/film/groups.h"
#include "core/kernel/camera.h"
#include "core/kernel/event.h"

/// Sharing of second vertices between pixels: P. Bekaert, M. Sbert, J. Halton, Accelerating Path Tracing by Re-Using
/// Paths, Eurographics Workshop on Rendering 2002. Interiors are lit by way of their walls, so most of their noise is
/// in what leaves the second vertex of a path. Here the paths of eight pixels are taken together: the light that leaves
/// each path's second vertex also reaches the first vertices of the seven others, if nothing is in the way. Which of
/// the eight could have found that vertex, and how likely, weighs it (the balance heuristic), so nothing is counted
/// twice and nothing is left out.
///
/// A group takes samples of one index only; so a sample is a pure function of the group's place and its index, and the
/// two halves of a film stay independent.
namespace tyndall {

/// Whether a path's vertex can be one of the first or second vertices that are shared, each of which scatters evenly:
/// its light does not depend on the direction in which it leaves.
template <class F>
TYNDALL_INLINE MaskOf<F> scatters_evenly(const auto& s, const Event<F>& e) {
  const auto surface = mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Lambertian<double>>())));
  if (!s.has_media()) return surface;
  return mask_or(surface, mask_and(e.medium, equal(e.g, F(0.0f))));
}

/// The samples of some groups, one of each member, and what is shared of their paths. Each array has a row for each
/// member, in which groups lie side by side: lanes work on groups.
struct SharedPaths {
  static constexpr int most_groups = 256, room = group_size * most_groups;
  static constexpr std::int32_t unwanted = -1, outside = -2;  ///< of the unit's tile; of the picture

  int groups = 0;
  alignas(64) std::int32_t x[most_groups];  ///< pixel of the group's first member, in full-image coordinates
  alignas(64) std::int32_t y[most_groups];
  alignas(64) std::uint32_t index[most_groups];  ///< of the sample
  alignas(64) std::int32_t pixel[room];  ///< where its sample goes: index within the tile; unwanted or outside: nowhere

  alignas(64) float own[3][room];  ///< radiance of the path but for what leaves its second vertex
  // The first vertex: where it is, the side on which it scatters (0 in a medium), its albedo.
  alignas(64) float first[3][room], first_facing[3][room], albedo[3][room];
  alignas(64) float first_even[room];  ///< 0 on a surface, 1/4 in a medium, minus infinity where there is no vertex
  alignas(64) std::int32_t first_from[room];
  // The second vertex.
  alignas(64) float second[3][room], second_facing[3][room];
  alignas(64) float second_even[room];  ///< 0 on a surface, 1 in a medium, minus infinity where there is no vertex
  alignas(64) std::int32_t second_element[room];
  alignas(64) float leaving[3][room];  ///< radiance that leaves it

  TYNDALL_INLINE void clear() {
    for (int i = 0; i < room; ++i) {
      pixel[i] = outside;
      own[0][i] = own[1][i] = own[2][i] = 0;
      first_even[i] = second_even[i] = -__builtin_inff();
    }
  }
};

/// The paths of the kernels that do not share.
struct NoSharing {};

/// Stores the values of some lanes at their slots.
template <class F, int columns>
TYNDALL_INLINE void put(float(*const (&to)[columns]), const F (&values)[columns], const std::int32_t* slot,
                        std::uint32_t lanes) {
  alignas(64) float value[columns][lanes_of<F>];
  for (int k = 0; k < columns; ++k) store(value[k], values[k]);
  for (; lanes; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    for (int k = 0; k < columns; ++k) to[k][slot[lane]] = value[k][lane];
  }
}

/// Notes the first vertices of the paths in `lanes`.
template <class F>
TYNDALL_INLINE void note_first(const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, SharedPaths& shared) {
  alignas(64) std::int32_t slot[lanes_of<F>], from[lanes_of<F>];
  store(slot, p.slot), store(from, e.from);
  const Vec3<F> facing = select(e.medium, zero3<F>(), e.incident.facing), albedo = p.throughput * e.colour;
  const F values[] = {e.point.x, e.point.y, e.point.z, facing.x, facing.y,
                      facing.z,  albedo.x,  albedo.y,  albedo.z, select(e.medium, F(0.25f), F(0.0f))};
  float* const to[] = {shared.first[0],        shared.first[1],        shared.first[2],  shared.first_facing[0],
                       shared.first_facing[1], shared.first_facing[2], shared.albedo[0], shared.albedo[1],
                       shared.albedo[2],       shared.first_even};
  put<F>(to, values, slot, bits(lanes));
  for (std::uint32_t left = bits(lanes); left; left &= left - 1) {
    const int lane = __builtin_ctz(left);
    shared.first_from[slot[lane]] = from[lane];
  }
}

/// Notes the second vertices of the paths in `lanes`, and what the paths have gathered before them. From here on these
/// paths gather what leaves the second vertex. They carry a grey throughput, as if it came to a white first vertex, so
/// that no colour is lost that another path's first vertex may reflect.
template <class F>
TYNDALL_INLINE void note_second(Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, SharedPaths& shared) {
  alignas(64) std::int32_t slot[lanes_of<F>], element[lanes_of<F>];
  store(slot, p.slot), store(element, select(e.surface, e.at.element, IntOf<F>(-1)));
  const Vec3<F> facing = select(e.medium, zero3<F>(), e.incident.facing);
  const F values[] = {e.point.x, e.point.y,    e.point.z,    facing.x,     facing.y,
                      facing.z,  p.radiance.x, p.radiance.y, p.radiance.z, select(e.medium, F(1.0f), F(0.0f))};
  float* const to[] = {shared.second[0],        shared.second[1],        shared.second[2], shared.second_facing[0],
                       shared.second_facing[1], shared.second_facing[2], shared.own[0],    shared.own[1],
                       shared.own[2],           shared.second_even};
  put<F>(to, values, slot, bits(lanes));
  for (std::uint32_t left = bits(lanes); left; left &= left - 1) {
    const int lane = __builtin_ctz(left);
    shared.second_element[slot[lane]] = element[lane];
  }
  const F grey = max_component(p.throughput);
  p.throughput = select(lanes, Vec3<F>{grey, grey, grey}, p.throughput);
  p.radiance = select(lanes, zero3<F>(), p.radiance);
}

}  // namespace tyndall

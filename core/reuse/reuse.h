#pragma once
#include "core/film/groups.h"
#include "core/transport/event.h"

/// Reuse of second vertices between pixels: P. Bekaert, M. Sbert, J. Halton, Accelerating Path Tracing by Re-Using
/// Paths, Eurographics Workshop on Rendering 2002. Interiors are mostly lit by their walls, so most of their noise is
/// in the radiance that leaves the second vertex of a path. Here the paths of eight pixels form a group: the radiance
/// that leaves each path's second vertex also reaches the first vertices of the seven others, if nothing blocks it. It
/// is weighted by the pdfs with which the eight paths would have found that vertex (the balance heuristic), so that
/// nothing is counted twice and nothing is left out.
///
/// A group takes samples of one index only, so that a sample is a pure function of the group's place and its index, and
/// the two halves of a film stay independent.
namespace tyndall {

/// Number of groups that are in work at a time. Each array below has a row for each member of a group.
inline constexpr int max_reuse_groups = 256, reuse_room = group_size * max_reuse_groups;

/// The first or the second vertices of paths.
struct ReusedVertices {
  alignas(64) float point[3][reuse_room];
  alignas(64) float facing[3][reuse_room];  ///< unit normal of the side on which the path scatters; 0 in a medium
  /// What to add to a cosine: 0 on a surface; in a medium, which has no cosine (facing is 0), 1/4 at first vertices and
  /// 1 at second ones. Minus infinity where there is no vertex.
  alignas(64) float even[reuse_room];
  alignas(64) std::int32_t surface[reuse_room];  ///< Ray::from of first vertices; element of second ones, or -1
};

/// The samples of some groups, one for each member, and the parts of their paths that are reused.
struct ReusedPaths {
  static constexpr int max_groups = max_reuse_groups, room = reuse_room;
  static constexpr std::int32_t unwanted = -1, outside = -2;  ///< outside of the job's tile; outside of the picture

  int groups = 0;
  alignas(64) std::int32_t x[max_groups];  ///< pixel of the group's first member, in full-image coordinates
  alignas(64) std::int32_t y[max_groups];
  alignas(64) std::uint32_t index[max_groups];  ///< of the sample
  alignas(64) std::int32_t pixel[room];  ///< where the sample goes: index within the tile; unwanted or outside: nowhere

  alignas(64) float own[3][room];  ///< radiance of the path without what leaves its second vertex
  ReusedVertices first, second;
  alignas(64) float albedo[3][room];             ///< of the first vertex
  alignas(64) float leaving[3][room];            ///< radiance that leaves the second vertex
  alignas(64) float by_specular_paths[3][room];  ///< added to `leaving` by specular paths; only in scenes with them

  TYNDALL_INLINE void clear() {
    for (int i = 0; i < room; ++i) {
      pixel[i] = outside;
      own[0][i] = own[1][i] = own[2][i] = 0;
      by_specular_paths[0][i] = by_specular_paths[1][i] = by_specular_paths[2][i] = 0;
      first.even[i] = second.even[i] = -__builtin_inff();
    }
  }
};

/// Stores the vertices at which the paths in `lanes` are. in_medium: value of ReusedVertices::even for vertices in
/// media. colour: goes to `colours`.
template <class F>
TYNDALL_INLINE void note_vertices(const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, float in_medium,
                                  IntOf<F> surface, Vec3<F> colour, ReusedVertices& to,
                                  float (&colours)[3][reuse_room]) {
  constexpr int columns = 10;
  const Vec3<F> facing = select(e.medium, zero3<F>(), e.incident.facing);
  const F even = select(e.medium, splat<F>(in_medium), F(0.0f));
  const F values[columns] = {e.point.x, e.point.y, e.point.z, facing.x, facing.y,
                             facing.z,  colour.x,  colour.y,  colour.z, even};
  float* const all[columns] = {to.point[0],  to.point[1], to.point[2], to.facing[0], to.facing[1],
                               to.facing[2], colours[0],  colours[1],  colours[2],   to.even};
  alignas(64) float value[columns][lanes_of<F>];
  alignas(64) std::int32_t slots[lanes_of<F>], surfaces[lanes_of<F>];
  for (int k = 0; k < columns; ++k) store(value[k], values[k]);
  store(slots, p.slot), store(surfaces, surface);
  for (std::uint32_t left = bits(lanes); left; left &= left - 1) {
    const int lane = __builtin_ctz(left), slot = slots[lane];
    for (int k = 0; k < columns; ++k) all[k][slot] = value[k][lane];
    to.surface[slot] = surfaces[lane];
  }
}

template <class F>
TYNDALL_INLINE void note_first(const auto& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                               ReusedPaths& reused) {
  note_vertices<F>(p, e, lanes, 0.25f, e.from, weighed(s, p, p.throughput * e.colour), reused.first, reused.albedo);
}

/// Stores the second vertices of the paths in `lanes`, and what the paths have gathered before them. From here on these
/// paths gather what leaves the second vertex. They carry a grey throughput, as if the first vertex were white, so that
/// no colour is lost that the first vertex of another path may reflect.
template <class F>
TYNDALL_INLINE void note_second(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, ReusedPaths& reused) {
  const IntOf<F> element = select(e.surface, e.at.element, IntOf<F>(-1));
  note_vertices<F>(p, e, lanes, 1.0f, element, weighed(s, p, p.radiance), reused.second, reused.own);
  const F grey = max_component(p.throughput);
  p.throughput = select(lanes, Vec3<F>{grey, grey, grey}, p.throughput);
  p.radiance = select(lanes, zero3<F>(), p.radiance);
}

}  // namespace tyndall

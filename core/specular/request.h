#pragma once
#include "core/base/random.h"
#include "core/materials/bsdf.h"
#include "core/trace/flight.h"

namespace tyndall {

/// What an event at a diffuse surface or in media requests: the light that specular paths bring to it.
template <class F>
struct SpecularRequest {
  Vec3<F> point;
  Vec3<F> facing;  ///< unit; at a surface its normal on the side of the incoming path, in media the path's direction
  Vec3<F> throughput;  ///< of light from there into the sample: the path's own times the albedo
  F time;
  F g;                 ///< asymmetry of the medium's phase function
  IntOf<F> from;       ///< Ray::from of rays that leave the point
  IntOf<F> depth;      ///< scattering events before this one
  IntOf<F> slot;       ///< identifies the sample
  Sampler<F> sampler;  ///< at this event
  MaskOf<F> in_medium;
};

/// Calls number(row, x) or integer(row, x) for each member of the requests; row: its column in a queue.
template <class F>
TYNDALL_INLINE void each_part(const auto&, SpecularRequest<F>& q, const auto& number, const auto& integer) {
  IntOf<F> low = as_int(q.sampler.low), high = as_int(q.sampler.high), event = as_int(q.sampler.event);
  IntOf<F> in_medium = select(q.in_medium, IntOf<F>(1), IntOf<F>(0));
  number(0, q.point.x), number(1, q.point.y), number(2, q.point.z);
  number(3, q.facing.x), number(4, q.facing.y), number(5, q.facing.z);
  number(6, q.throughput.x), number(7, q.throughput.y), number(8, q.throughput.z);
  number(9, q.time), number(10, q.g);
  integer(0, q.from), integer(1, q.depth), integer(2, q.slot);
  integer(3, low), integer(4, high), integer(5, event), integer(6, in_medium);
  q.sampler.low = as_uint(low), q.sampler.high = as_uint(high), q.sampler.event = as_uint(event);
  q.in_medium = equal(in_medium, IntOf<F>(1));
}

/// Pdf, per steradian, with which light scatters at the requests' points into `direction`.
template <class F>
TYNDALL_INLINE F scattered_pdf(const auto& s, const SpecularRequest<F>& q, Vec3<F> direction) {
  Incident<F> in{};
  in.facing = q.facing;
  const F diffuse = diffuse_pdf(in, direction);
  if (!s.has_media() || !any(q.in_medium)) return diffuse;
  return select(q.in_medium, phase_pdf(s, q.g, q.facing, direction), diffuse);
}

}  // namespace tyndall

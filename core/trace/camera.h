#pragma once
#include "core/base/ray.h"
#include "core/base/sampling.h"
#include "core/trace/scene_view.h"
#include "core/trace/tile_job.h"

/// Camera rays: which samples a tile job holds, and the ray that each of them starts with.
namespace tyndall {

/// Ray::from of rays that leave the lens at `offset` from its centre, for a camera that stands on a surface. Rays that
/// start on the surface go out of it or into it (see CameraSurface); other rays get from_nowhere. Over a sphere a point
/// of the lens is higher by the squared distance from the normal over the sphere's diameter, up to third order.
template <class F>
TYNDALL_INLINE IntOf<F> leave_camera_surface(const CameraSurface& c, Vec3<F> offset, Vec3<F> direction) {
  using I = IntOf<F>;
  const Vec3<F> normal = splat<F>(c.normal);
  const F rise = dot(normal, offset), across2 = neg_mul_add(rise, rise, dot(offset, offset));
  const F curvature = splat<F>(c.curvature);
  const F height = splat<F>(c.height) + mul_add(F(0.5f) * curvature, across2, rise);
  const auto outward = less_equal(F(0.0f), dot(direction, point_at(normal, curvature, offset)));
  const F ahead = select(outward, height, -height);  // height of the start on the side to which the ray goes
  const auto on = mask_and(less_equal(abs(height), splat<F>(c.rounding)), less_equal(splat<F>(-c.touching), ahead));
  const std::int32_t first = 4 * c.element;
  return select(on,
                select(outward, I(first + static_cast<std::int32_t>(Side::outward)),
                       I(first + static_cast<std::int32_t>(Side::inward))),
                I(from_nowhere));
}

/// The ray through the point (x, y) of the picture, in pixels from its upper left corner. lens: where it leaves the
/// lens, a point in the unit disc. Ray Tracing in One Weekend, section 13.2 "Generating Sample Rays".
template <class F>
TYNDALL_INLINE Ray<F> camera_ray(const CameraColumns& c, F x, F y, Pair<F> lens, F time) {
  const Vec3<F> target = point_at(point_at(splat<F>(c.corner), x, splat<F>(c.du)), y, splat<F>(c.dv));
  const Vec3<F> offset = point_at(lens.x * splat<F>(c.lens_u), lens.y, splat<F>(c.lens_v));
  Ray<F> ray{splat<F>(c.center) + offset, normalize(target - offset), time, IntOf<F>(from_nowhere)};
  if (c.surface.element >= 0) ray.from = leave_camera_surface(c.surface, offset, ray.direction);
  return ray;
}

/// The ray of one sample through the point (x, y) of the picture.
template <class F>
TYNDALL_INLINE Ray<F> ray_through(const SceneView& s, F x, F y, const Sampler<F>& sampler) {
  Pair<F> lens{F(0.0f), F(0.0f)};
  if (s.features.lens) lens = in_disc(sampler.next_2d(dimension::lens));
  F time = splat<F>(s.camera.shutter_open);
  if (s.features.shutter) time = mul_add(sampler.next_1d(dimension::time), splat<F>(s.camera.shutter_length), time);
  return camera_ray(s.camera, x, y, lens, time);
}

inline constexpr int max_tile_pixels = 4096;

/// The samples to take next, one in each lane.
template <int lanes>
struct CameraSamples {
  alignas(64) std::int32_t x[lanes] = {}, y[lanes] = {};  ///< pixel, in full-image coordinates
  alignas(64) std::uint32_t index[lanes] = {};
  alignas(64) std::int32_t slot[lanes] = {};  ///< see Paths::slot
  int count = 0;
};

/// The samples of a tile job, in the order in which lanes take them: one sample of every pixel, then a second one of
/// every pixel, and so on.
struct TileSamples {
  std::uint16_t column[max_tile_pixels], row[max_tile_pixels];  ///< within the tile
  std::uint32_t start[max_tile_pixels];                         ///< index of each pixel's first sample
  int x0, y0, width;                                            ///< of the tile
  const std::uint32_t *first_of, *last_of;                      ///< see TileJob
  int pixels;
  int pixel;            ///< the next one, as an index into these lists
  std::uint32_t round;  ///< number of the pixel's next sample, counted from 0
  std::uint32_t rounds;
  std::uint32_t next_finish;       ///< no pixel is done before this round
  SubpixelLights subpixel_lights;  ///< of the rows of the tile

  TYNDALL_INLINE bool empty() const { return round >= rounds; }
  TYNDALL_INLINE int place(int i) const { return row[i] * width + column[i]; }
  /// Fills lanes with the next samples, as long as there are any.
  template <int lanes>
  TYNDALL_INLINE void take(CameraSamples<lanes>& to) {
    while (to.count < lanes && !empty()) {
      const int room = lanes - to.count, left = pixels - pixel, count = left < room ? left : room;
      for (int i = 0; i < count; ++i) {
        const int k = to.count + i;
        to.x[k] = x0 + column[pixel + i], to.y[k] = y0 + row[pixel + i];
        to.index[k] = start[pixel + i] + round;
        to.slot[k] = 2 * place(pixel + i) + static_cast<std::int32_t>(to.index[k] & 1u);
      }
      to.count += count, pixel += count;
      if (pixel < pixels) continue;
      pixel = 0, ++round;
      if (round == next_finish) drop_finished();
    }
  }
  /// Removes the pixels that are done from the list.
  TYNDALL_INLINE void drop_finished() {
    int kept = 0;
    next_finish = ~0u;
    for (int i = 0; i < pixels; ++i) {
      const int at = place(i);
      const std::uint32_t count = last_of[at] - first_of[at];
      if (count <= round) continue;
      if (count < next_finish) next_finish = count;
      column[kept] = column[i], row[kept] = row[i], start[kept] = first_of[at];
      ++kept;
    }
    pixels = kept;
    if (pixels == 0) rounds = round;
  }
};

TYNDALL_INLINE void list_samples(const SceneView& s, const TileJob& job, TileSamples& list) {
  list.subpixel_lights = subpixel_lights_in_rows(s.subpixel_lights, job.tile.y0, job.tile.y1);
  list.pixels = 0;
  const auto first_multiple = [&](int from) { return (from + job.step - 1) / job.step * job.step; };
  for (int y = first_multiple(job.tile.y0); y < job.tile.y1; y += job.step)
    for (int x = first_multiple(job.tile.x0); x < job.tile.x1; x += job.step) {
      if (job.skip_step > 0 && x % job.skip_step == 0 && y % job.skip_step == 0) continue;
      list.column[list.pixels] = static_cast<std::uint16_t>(x - job.tile.x0);
      list.row[list.pixels] = static_cast<std::uint16_t>(y - job.tile.y0);
      list.start[list.pixels] = job.first;
      ++list.pixels;
    }
  list.x0 = job.tile.x0, list.y0 = job.tile.y0, list.width = job.tile.x1 - job.tile.x0;
  list.first_of = job.first_of, list.last_of = job.last_of;
  list.pixel = 0;
  list.round = 0;
  list.rounds = list.pixels ? job.last - job.first : 0;
  list.next_finish = ~0u;
  if (!job.first_of) return;
  list.rounds = ~0u;
  list.drop_finished();
}

/// The next samples of a tile job, one in each lane, and the rays that they start with.
template <class F>
struct NewSamples {
  Ray<F> ray;
  UintOf<F> low, high;  ///< see Sampler
  AtSubpixelLights<F> subpixel_lights;
  IntOf<F> slot;  ///< see Paths::slot
  int count;      ///< lanes from this one on are empty
};

/// Takes the next samples off the list, which must not be empty, and makes their rays.
template <class F>
[[gnu::noinline]] static NewSamples<F> take_samples(auto& samples, const SceneView& s) {
  constexpr int lanes = lanes_of<F>;
  CameraSamples<lanes> next;
  samples.take(next);
  const IntOf<F> column = load<F>(next.x), row = load<F>(next.y);
  const F x = from_int<F>(column), y = from_int<F>(row);
  const Sampler<F> sampler = Sampler<F>::of(s.seed, as_uint(column), as_uint(row), load<F>(next.index), s.sampler);
  NewSamples<F> taken;
  Pair<F> in_pixel = sampler.next_2d(dimension::pixel);
  taken.subpixel_lights = {F(1.0f), {IntOf<F>(0)}};
  const SubpixelLights& subpixel_lights = samples.subpixel_lights();
  if (subpixel_lights.first != subpixel_lights.last)
    taken.subpixel_lights = aim_at_subpixel_lights(subpixel_lights, x, y, in_pixel);
  taken.ray = ray_through(s, x + in_pixel.x, y + in_pixel.y, sampler);
  taken.low = sampler.low, taken.high = sampler.high;
  taken.slot = load<F>(next.slot), taken.count = next.count;
  return taken;
}

}  // namespace tyndall

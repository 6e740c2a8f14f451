#pragma once
#include "core/base/ray.h"
#include "core/base/sampling.h"
#include "core/trace/scene_view.h"
#include "core/trace/work.h"

/// Camera rays: which samples a unit of work holds, and the ray with which each of them starts.
namespace tyndall {

/// Ray::from of rays that leave the lens at `offset` from its centre, for a camera that stands on a surface: they go
/// out of the surface or into it where they start on it (see CameraSurface), and start nowhere elsewhere. Over a sphere
/// a point of the lens is higher by the square of its distance from the normal over the sphere's diameter, up to third
/// order.
template <class F>
TYNDALL_INLINE IntOf<F> leave_camera_surface(const CameraSurface& c, Vec3<F> offset, Vec3<F> direction) {
  using I = IntOf<F>;
  const Vec3<F> normal = splat<F>(c.normal);
  const F rise = dot(normal, offset), across2 = neg_mul_add(rise, rise, dot(offset, offset));
  const F curvature = splat<F>(c.curvature);
  const F height = splat<F>(c.height) + mul_add(F(0.5f) * curvature, across2, rise);
  const auto outward = less_equal(F(0.0f), dot(direction, along(normal, curvature, offset)));
  const F ahead = select(outward, height, -height);  // how far the start is on the side to which the ray goes
  const auto on = mask_and(less_equal(abs(height), splat<F>(c.rounding)), less_equal(splat<F>(-c.touching), ahead));
  const std::int32_t first = 4 * c.element;
  return select(on,
                select(outward, I(first + static_cast<std::int32_t>(Side::outward)),
                       I(first + static_cast<std::int32_t>(Side::inward))),
                I(from_nowhere));
}

/// The ray through a point (x, y) of the picture, in pixels from its upper left corner. lens: where it leaves the lens,
/// a point in the unit disc.
/// Ray Tracing in One Weekend, section 13.2 "Generating Sample Rays".
template <class F>
TYNDALL_INLINE Ray<F> camera_ray(const CameraColumns& c, F x, F y, Pair<F> lens, F time) {
  const Vec3<F> target = along(along(splat<F>(c.corner), x, splat<F>(c.du)), y, splat<F>(c.dv));
  const Vec3<F> offset = along(lens.x * splat<F>(c.lens_u), lens.y, splat<F>(c.lens_v));
  Ray<F> ray{splat<F>(c.center) + offset, normalize(target - offset), time, IntOf<F>(from_nowhere)};
  if (c.surface.element >= 0) ray.from = leave_camera_surface(c.surface, offset, ray.direction);
  return ray;
}

/// The ray of one sample through the point (x, y) of the picture.
template <class F>
TYNDALL_INLINE Ray<F> ray_through(const SceneView& s, F x, F y, const Dice<F>& dice) {
  Pair<F> lens{F(0.0f), F(0.0f)};
  if (s.needs.lens) lens = in_disc(dice.pair(dimension::lens));
  F time = splat<F>(s.camera.shutter_open);
  if (s.needs.shutter) time = mul_add(dice.one(dimension::time), splat<F>(s.camera.shutter_length), time);
  return camera_ray(s.camera, x, y, lens, time);
}

/// The ray of one sample of the pixel (x, y), if it has no glints.
template <class F>
TYNDALL_INLINE Ray<F> sample_ray(const SceneView& s, F x, F y, const Dice<F>& dice) {
  const Pair<F> in_pixel = dice.pair(dimension::pixel);
  return ray_through(s, x + in_pixel.x, y + in_pixel.y, dice);
}

inline constexpr int most_unit_pixels = 4096;

/// Samples that are to be taken next, one in each lane.
template <int lanes>
struct CameraSamples {
  alignas(64) std::int32_t x[lanes] = {}, y[lanes] = {};  ///< pixel, in full-image coordinates
  alignas(64) std::uint32_t index[lanes] = {};
  alignas(64) std::int32_t slot[lanes] = {};  ///< see Paths::slot
  int count = 0;
};

/// The samples of a unit, in the order in which lanes take them: first one sample of every pixel, then the next one of
/// every pixel, and so on.
struct UnitSamples {
  std::uint16_t column[most_unit_pixels], row[most_unit_pixels];  ///< within the tile
  std::uint32_t start[most_unit_pixels];                          ///< first sample of each pixel
  int x0, y0, width;                                              ///< of the tile
  const std::uint32_t *first_of, *last_of;                        ///< see Unit
  int pixels;
  int pixel;            ///< the next one, as an index into these lists
  std::uint32_t round;  ///< its next sample, counted from the pixel's first
  std::uint32_t rounds;
  std::uint32_t next_finish;  ///< the round before which no pixel has all its samples
  Glints glints;              ///< those in the rows of the tile

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
  /// Removes the pixels that have all their samples from the list.
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

TYNDALL_INLINE void list_samples(const SceneView& s, const Unit& unit, UnitSamples& list) {
  list.glints = glints_in_rows({s.glints, s.glints + s.glint_count}, unit.tile.y0, unit.tile.y1);
  list.pixels = 0;
  const auto first_multiple = [&](int from) { return (from + unit.step - 1) / unit.step * unit.step; };
  for (int y = first_multiple(unit.tile.y0); y < unit.tile.y1; y += unit.step)
    for (int x = first_multiple(unit.tile.x0); x < unit.tile.x1; x += unit.step) {
      if (unit.skip_step > 0 && x % unit.skip_step == 0 && y % unit.skip_step == 0) continue;
      list.column[list.pixels] = static_cast<std::uint16_t>(x - unit.tile.x0);
      list.row[list.pixels] = static_cast<std::uint16_t>(y - unit.tile.y0);
      list.start[list.pixels] = unit.first;
      ++list.pixels;
    }
  list.x0 = unit.tile.x0, list.y0 = unit.tile.y0, list.width = unit.tile.x1 - unit.tile.x0;
  list.first_of = unit.first_of, list.last_of = unit.last_of;
  list.pixel = 0;
  list.round = 0;
  list.rounds = list.pixels ? unit.last - unit.first : 0;
  list.next_finish = ~0u;
  if (!unit.first_of) return;
  list.rounds = ~0u;
  list.drop_finished();
}

/// The next samples of a unit, one in each lane, and the rays with which they start.
template <class F>
struct NewSamples {
  Ray<F> ray;
  UintOf<F> low, high;  ///< see Dice
  AtGlints<F> glints;
  IntOf<F> slot;  ///< see Paths::slot
  int count;      ///< lanes from this one on have no sample
};

/// Takes the next samples off the list, of which there has to be at least one, and makes their rays.
template <class F>
[[gnu::noinline]] static NewSamples<F> take_samples(auto& samples, const SceneView& s) {
  constexpr int lanes = lanes_of<F>;
  CameraSamples<lanes> next;
  samples.take(next);
  const IntOf<F> column = load_int<F>(next.x), row = load_int<F>(next.y);
  const F x = from_int<F>(column), y = from_int<F>(row);
  const Dice<F> dice = Dice<F>::of(s.seed, as_uint(column), as_uint(row), load_uint<F>(next.index), s.sampler);
  NewSamples<F> taken;
  Pair<F> in_pixel = dice.pair(dimension::pixel);
  taken.glints = {F(1.0f), {IntOf<F>(0)}};
  const Glints& glints = samples.glints();
  if (glints.first != glints.last) taken.glints = aim_at_glints(glints, x, y, in_pixel);
  taken.ray = ray_through(s, x + in_pixel.x, y + in_pixel.y, dice);
  taken.low = dice.low, taken.high = dice.high;
  taken.slot = load_int<F>(next.slot), taken.count = next.count;
  return taken;
}

}  // namespace tyndall

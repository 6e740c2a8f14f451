#pragma once
#include "core/base/ray.h"
#include "core/base/sampling.h"
#include "core/kernel/kernels.h"
#include "core/kernel/scene_view.h"

/// Camera rays: which samples a unit of work holds, and the ray with which each of them starts.
namespace tyndall {

/// The ray through a point (x, y) of the picture, in pixels from its upper left corner. lens: where it leaves the lens,
/// a point in the unit disc.
/// Ray Tracing in One Weekend, section 13.2 "Generating Sample Rays".
template <class F>
TYNDALL_INLINE Ray<F> camera_ray(const CameraColumns& c, F x, F y, Pair<F> lens, F time) {
  const Vec3<F> target = along(along(splat<F>(c.corner), x, splat<F>(c.du)), y, splat<F>(c.dv));
  const Vec3<F> offset = along(lens.x * splat<F>(c.lens_u), lens.y, splat<F>(c.lens_v));
  return {splat<F>(c.center) + offset, normalize(target - offset), time, IntOf<F>(from_nowhere)};
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

/// One sample that is to be taken.
struct CameraSample {
  std::int32_t x, y;  ///< pixel, in full-image coordinates
  std::uint32_t index;
  std::int32_t slot;  ///< see Paths::slot
};

/// The samples of a unit, in the order in which lanes take them: first one sample of every pixel, then the next one of
/// every pixel, and so on.
struct UnitSamples {
  std::uint16_t column[most_unit_pixels], row[most_unit_pixels];  ///< within the tile
  std::uint32_t start[most_unit_pixels];                          ///< first sample, if each pixel has its own
  int x0, y0, width;                                              ///< of the tile
  const std::uint32_t *first_of, *last_of;                        ///< see Unit
  std::uint32_t first;
  int pixels;
  int pixel;            ///< the next one, as an index into these lists
  std::uint32_t round;  ///< its next sample, counted from the pixel's first
  std::uint32_t rounds;
  std::uint32_t next_finish;  ///< the round before which no pixel has all its samples
  Glints glints;              ///< those in the rows of the tile

  TYNDALL_INLINE bool empty() const { return round >= rounds; }
  TYNDALL_INLINE int place(int i) const { return row[i] * width + column[i]; }
  TYNDALL_INLINE CameraSample take() {
    const std::uint32_t index = (first_of ? start[pixel] : first) + round;
    const CameraSample sample{x0 + column[pixel], y0 + row[pixel], index,
                              2 * place(pixel) + static_cast<std::int32_t>(index & 1u)};
    if (++pixel < pixels) return sample;
    pixel = 0;
    ++round;
    if (round == next_finish) drop_finished();
    return sample;
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
      ++list.pixels;
    }
  list.x0 = unit.tile.x0, list.y0 = unit.tile.y0, list.width = unit.tile.x1 - unit.tile.x0;
  list.first_of = unit.first_of, list.last_of = unit.last_of;
  list.first = unit.first;
  list.pixel = 0;
  list.round = 0;
  list.rounds = list.pixels ? unit.last - unit.first : 0;
  list.next_finish = ~0u;
  if (!unit.first_of) return;
  list.rounds = ~0u;
  list.drop_finished();
}

/// New camera rays, computed in all lanes at once, that wait until lanes of the path loop become free.
template <class F>
struct CameraQueue {
  static constexpr int lanes = lanes_of<F>;
  alignas(64) float ox[lanes + 1], oy[lanes + 1], oz[lanes + 1], dx[lanes + 1], dy[lanes + 1], dz[lanes + 1];
  alignas(64) float time[lanes + 1], weight[lanes + 1];
  alignas(64) std::int32_t low[lanes + 1], high[lanes + 1], way[lanes + 1];
  std::int32_t slot[lanes + 1];  ///< 2 · pixel within the tile + half
  int next = 0, end = 0;
};

/// Fills the queue with the rays of the next samples.
template <class F>
[[gnu::noinline]] static void refill(CameraQueue<F>& queue, auto& samples, const SceneView& s) {
  constexpr int lanes = lanes_of<F>;
  alignas(64) float x[lanes] = {}, y[lanes] = {};
  alignas(64) std::uint32_t ix[lanes] = {}, iy[lanes] = {}, index[lanes] = {};
  queue.next = queue.end = 0;
  for (; queue.end < lanes && !samples.empty(); ++queue.end) {
    const int k = queue.end;
    const CameraSample sample = samples.take();
    ix[k] = static_cast<std::uint32_t>(sample.x), iy[k] = static_cast<std::uint32_t>(sample.y);
    x[k] = static_cast<float>(ix[k]), y[k] = static_cast<float>(iy[k]);
    index[k] = sample.index;
    queue.slot[k] = sample.slot;
  }
  const Dice<F> dice = Dice<F>::of(s.seed, load_uint<F>(ix), load_uint<F>(iy), load_uint<F>(index), s.sampler);
  Pair<F> in_pixel = dice.pair(dimension::pixel);
  AtGlints<F> glints{F(1.0f), IntOf<F>(0)};
  if (samples.glints.first != samples.glints.last)
    glints = aim_at_glints(samples.glints, load<F>(x), load<F>(y), in_pixel);
  const Ray<F> ray = ray_through(s, load<F>(x) + in_pixel.x, load<F>(y) + in_pixel.y, dice);
  store(queue.ox, ray.origin.x), store(queue.oy, ray.origin.y), store(queue.oz, ray.origin.z);
  store(queue.dx, ray.direction.x), store(queue.dy, ray.direction.y), store(queue.dz, ray.direction.z);
  store(queue.time, ray.time), store(queue.weight, glints.weight), store(queue.way, glints.way);
  store(queue.low, as_int(dice.low)), store(queue.high, as_int(dice.high));
}

}  // namespace tyndall

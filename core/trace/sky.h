#pragma once
#include "core/base/math.h"
#include "core/trace/lights.h"

/// A picture of the sky: its radiance in a direction, and directions drawn by its luminance.
///
/// The picture is an equirectangular map: u = 0.5 is towards -z, u = 0.75 towards +x, v = 1 towards +y. Between the
/// middles of texels radiance is bilinear. The unit square of (u, v) is divided into cells within each of which it is
/// one bilinear function. A row of cells is drawn by inverting the marginal distribution, a cell of it by inverting the
/// conditional one (M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th edition, sections 12.5 and
/// A.5), and a place in the cell by its bilinear luminance (section 2.4). So the pdf follows the luminance, and
/// only the sine of the polar angle is constant within a row.
///
/// The distributions are whole numbers of 2^-24, the steps of the random numbers: cells have exactly the probability
/// that the pdf says, also the darkest beside a sun.
namespace tyndall {

template <class F>
struct SkySample {
  Vec3<F> direction;  ///< unit
  Vec3<F> radiance;
  F pdf;  ///< per steradian; 0: no light comes from there
};

/// The radiance at the corners of a cell, without the sky's scale: above, below; left, right.
template <class F>
struct SkyCell {
  IntOf<F> row, column;
  Vec3<F> above_left, above_right, below_left, below_right;
};

template <class F>
TYNDALL_INLINE Vec3<F> mix(Vec3<F> a, Vec3<F> b, F t) {
  return point_at(a, t, b - a);
}

template <class F>
TYNDALL_INLINE SkyCell<F> load_sky_cell(const SkyColumns& sky, IntOf<F> row, IntOf<F> column) {
  using I = IntOf<F>;
  const F step = splat<F>(1 / static_cast<float>(sky.distribution.rows_per_texel)), half = F(0.5f);
  const F y = mul_add(from_int<F>(row), step, F(-0.5f)), above = floor(mul_add(half, step, y));
  const F last = splat<F>(static_cast<float>(sky.height - 1)), first = F(0.0f);
  const I top = to_int(min(max(above, first), last)), bottom = to_int(min(max(above + F(1.0f), first), last));
  const I next = column + I(1), right = select(less(next, I(sky.width)), next, I(0));
  const auto texel = [&](I at_row, I at_column) __attribute__((always_inline)) {
    const I at = (at_row * I(sky.width) + at_column) * I(3);
    return Vec3<F>{gather<F>(sky.texels, at), gather<F>(sky.texels + 1, at), gather<F>(sky.texels + 2, at)};
  };
  const Vec3<F> tl = texel(top, column), tr = texel(top, right), bl = texel(bottom, column), br = texel(bottom, right);
  const F from = y - above, to = from + step;
  return {row, column, mix(tl, bl, from), mix(tr, br, from), mix(tl, bl, to), mix(tr, br, to)};
}

/// Radiance at (s, t), both in [0, 1], of a cell, and the pdf of that direction. sine: of the polar angle.
template <class F>
TYNDALL_INLINE SkySample<F> sky_in_cell(const SkyColumns& sky, const SkyCell<F>& cell, F s, F t, F sine) {
  using I = IntOf<F>;
  const Vec3<F> colour = mix(mix(cell.above_left, cell.above_right, s), mix(cell.below_left, cell.below_right, s), t);
  SkySample<F> out;
  out.radiance = splat<F>(sky.scale) * colour;
  out.pdf = F(0.0f);
  if (!sky.is_sampled()) return out;
  const auto part = [](const std::int32_t* ends, I at) __attribute__((always_inline)) {
    return from_int<F>(gather<F>(ends, at + I(1)) - gather<F>(ends, at)) * F(1.0f / SkyDistribution::draws);
  };
  const F probability = part(sky.distribution.row_ends, cell.row) *
                        part(sky.distribution.column_ends, cell.row * I(sky.width + 1) + cell.column);
  const F scale = splat<F>(sky.distribution.to_one), own = sky_luminance(colour, scale);
  const F mean = F(0.25f) * (sky_luminance(cell.above_left, scale) + sky_luminance(cell.above_right, scale) +
                             sky_luminance(cell.below_left, scale) + sky_luminance(cell.below_right, scale));
  const F cells = splat<F>(static_cast<float>(sky.width) * static_cast<float>(sky.distribution.rows) *
                           static_cast<float>(0.5 / (pi * pi)));
  const F pdf = cells * probability * (own / max(mean, F(1e-37f))) / max(sine, F(1e-12f));
  out.pdf = select(less(F(0.0f), own), pdf, F(0.0f));
  return out;
}

/// The sky in a direction (unit) that a ray has.
template <class F>
TYNDALL_INLINE SkySample<F> sky_towards(const SkyColumns& sky, Vec3<F> direction) {
  const F c = splat<F>(sky.cos), si = splat<F>(sky.sin), zero = F(0.0f), one = F(1.0f);
  const F x = mul_add(c, direction.x, -(si * direction.z)), z = mul_add(si, direction.x, c * direction.z);
  const F sine = sqrt(mul_add(x, x, z * z));
  const F u = mul_add(atan2(x, -z), F(static_cast<float>(0.5 / pi)), F(0.5f));
  const F v = atan2(sine, direction.y) * F(static_cast<float>(1 / pi));  // from the top
  const F columns = splat<F>(static_cast<float>(sky.width)), rows = splat<F>(static_cast<float>(sky.distribution.rows));
  const F across = mul_add(u, columns, F(-0.5f)), down = v * rows;
  const F left = floor(across), above = floor(down);
  // Clamped as well as wrapped: lanes that are not used may hold any number and still must not read beyond the tables.
  const F column = min(max(select(less(left, zero), columns - one, left), zero), columns - one);
  const F row = min(max(above, zero), rows - one);
  const SkyCell<F> cell = load_sky_cell<F>(sky, to_int(row), to_int(column));
  SkySample<F> out = sky_in_cell(sky, cell, min(max(across - left, zero), one), min(max(down - row, zero), one), sine);
  out.direction = direction;
  return out;
}

/// The cell, and the place in it, in [0, 1], that a random number k of SkyDistribution::draws values chooses. step: the
/// largest power of two up to `count`. jitter: the place within the step of the random number.
template <class F>
TYNDALL_INLINE void choose_cell(const std::int32_t* ends, IntOf<F> base, int count, int step, F u, F jitter,
                                IntOf<F>& cell, F& place) {
  using I = IntOf<F>;
  const I k = to_int(u * F(static_cast<float>(SkyDistribution::draws)));
  cell = I(0);
  for (; step > 0; step /= 2) {
    const I further = cell + I(step), probe = select(less(further, I(count)), further, I(count));
    cell = select(less_equal(gather<F>(ends, base + probe), k), probe, cell);
  }
  cell = select(less(cell, I(count)), cell, I(count - 1));
  const I begin = gather<F>(ends, base + cell), end = gather<F>(ends, base + cell + I(1));
  place = (from_int<F>(k - begin) + jitter) / max(from_int<F>(end - begin), F(1.0f));
}

/// Draws x in [0, 1] by a density that is linear, in proportion to a at 0 and to b at 1 (the same book, section 2.3).
template <class F>
TYNDALL_INLINE F draw_linear(F u, F a, F b) {
  const F below = a + sqrt(max(mul_add(u, b * b - a * a, a * a), F(0.0f)));
  return min(u * (a + b) / max(below, F(1e-37f)), F(1.0f));
}

/// Draws a direction to the sky by u in [0, 1)².
template <class F>
TYNDALL_INLINE SkySample<F> sample_sky(const SkyColumns& sky, const Sampler<F>& sampler, Pair<F> u) {
  using I = IntOf<F>;
  I row, column;
  F x, y;
  choose_cell<F>(sky.distribution.row_ends, I(0), sky.distribution.rows, sky.distribution.row_step, u.y,
                 sampler.independent_1d(dimension::sky_place), row, y);
  choose_cell<F>(sky.distribution.column_ends, row * I(sky.width + 1), sky.width, sky.distribution.column_step, u.x,
                 sampler.independent_1d(dimension::sky_place + 1), column, x);
  const SkyCell<F> cell = load_sky_cell<F>(sky, row, column);
  const F scale = splat<F>(sky.distribution.to_one);
  const F al = sky_luminance(cell.above_left, scale), ar = sky_luminance(cell.above_right, scale),
          bl = sky_luminance(cell.below_left, scale), br = sky_luminance(cell.below_right, scale);
  const F t = draw_linear(y, al + ar, bl + br);
  const F s = draw_linear(x, mul_add(t, bl - al, al), mul_add(t, br - ar, ar));
  const F from_left = (from_int<F>(column) + s + F(0.5f)) * splat<F>(1 / static_cast<float>(sky.width));
  const SinCos<F> around = sin_cos_2pi(select(less(from_left, F(1.0f)), from_left, from_left - F(1.0f)));
  const SinCos<F> polar = sin_cos_2pi(
      F(0.5f) * min((from_int<F>(row) + t) * splat<F>(1 / static_cast<float>(sky.distribution.rows)), F(1.0f)));
  SkySample<F> out = sky_in_cell(sky, cell, s, t, max(polar.sin, F(0.0f)));
  const F across = -polar.sin * around.sin, ahead = polar.sin * around.cos;  // x and z before the sky's turn
  const F c = splat<F>(sky.cos), si = splat<F>(sky.sin);
  out.direction = {mul_add(c, across, si * ahead), polar.cos, mul_add(c, ahead, -(si * across))};
  return out;
}

// ---- The sky among the other lights. Choices of a light name it by -1.

template <class F>
TYNDALL_INLINE MaskOf<F> is_sky(IntOf<F> light) {
  return less(light, IntOf<F>(0));
}

/// Probability with which a point samples the sky and not another light: the sky's irradiance over the sum of that and
/// the estimated contributions of the lights, which have the same unit, but at least min_sky and at most 1 - min_sky,
/// because either may be hidden.
inline constexpr float min_sky = 0.1f;
template <class F>
TYNDALL_INLINE F sky_probability(const auto& s, Vec3<F> point) {
  const Lights& l = s.lights;
  if (l.count() == 0) return F(1.0f);
  F others;
  if (l.count() <= max_lights_by_contribution) {
    others = total_worth(l, point);
  } else {
    const Vec3<F> to_root = splat<F>(l.tree.center[0]) - point;
    others = splat<F>(l.tree.power[0]) / max(dot(to_root, to_root), splat<F>(l.tree.reach2[0]));
  }
  const F own = splat<F>(s.sky.irradiance);
  return min(max(own / max(own + others, F(1e-37f)), F(min_sky)), F(1 - min_sky));
}

/// choose_light() among lights and sky.
template <class F>
TYNDALL_INLINE LightChoice<F> choose_light_or_sky(const auto& s, Vec3<F> point, F u) {
  using I = IntOf<F>;
  if (!s.samples_sky()) return choose_light(s.lights, point, u);
  if (s.lights.count() == 0) return {I(-1), F(1.0f)};
  const F own = sky_probability<F>(s, point), others = F(1.0f) - own;
  const auto sky = less(u, own);
  const LightChoice<F> choice = choose_light(s.lights, point, min(max((u - own) / others, F(0.0f)), F(0.99999994f)));
  return {select(sky, I(-1), choice.light), select(sky, own, others * choice.probability)};
}

/// Factor on the probability of choosing a light, for the sky that may be chosen in its place.
template <class F>
TYNDALL_INLINE F beside_sky(const auto& s, Vec3<F> point, F probability) {
  return s.samples_sky() ? probability * (F(1.0f) - sky_probability<F>(s, point)) : probability;
}

/// sample_light() of lights and sky. sky: set in scenes that sample it, in all lanes.
template <class F>
TYNDALL_INLINE LightSample<F> sample_light_or_sky(const auto& s, IntOf<F> light, const Ray<F>& at,
                                                  const Sampler<F>& sampler, Pair<F> u, SkySample<F>& sky) {
  if (!s.samples_sky()) return sample_light(s, light, at.origin, at.time, u);
  sky = sample_sky(s.sky, sampler, u);
  LightSample<F> out{sky.direction, F(__builtin_inff()), sky.pdf};
  const auto far = is_sky<F>(light);
  if (s.lights.count() == 0 || all(far)) return out;
  const LightSample<F> near = sample_light(s, select(far, IntOf<F>(0), light), at.origin, at.time, u);
  return {select(far, out.direction, near.direction), select(far, out.distance, near.distance),
          select(far, out.pdf, near.pdf)};
}

/// The element of a light; -1 for the sky.
template <class F>
TYNDALL_INLINE IntOf<F> element_of_light(const auto& s, IntOf<F> light) {
  using I = IntOf<F>;
  if (!s.samples_sky())
    return s.lights.count() == 1 ? I(s.lights.element[0]) : lookup<F>(s.lights.element, s.lights.count(), light);
  if (s.lights.count() == 0) return I(-1);
  const auto far = is_sky<F>(light);
  return select(far, I(-1), lookup<F>(s.lights.element, s.lights.count(), select(far, I(0), light)));
}

}  // namespace tyndall

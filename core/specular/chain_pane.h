#pragma once
#include "core/specular/chain_flat.h"
#include "core/specular/history.h"

/// Which ways through a pane are looked for, and with which probability each is. That depends on the point that asks
/// and on the lamp as a whole, so that the point of the lamp can be drawn afterwards, on the side that the way meets.
namespace tyndall {

inline constexpr int most_images = 2;           ///< that are looked for along each edge, to either side
inline constexpr float most_crossings = 13.0f;  ///< ways with more are left to scattering

/// A ball that holds a lamp at a given time.
template <class F>
struct LampBall {
  Vec3<F> center;
  F reach;  ///< its radius
};

template <class F>
TYNDALL_INLINE LampBall<F> ball_around(const LightColumns<F>& light, F time) {
  const F half_u = F(0.5f) * light.length_u, half_v = F(0.5f) * light.length_v;
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  return {select(round, sphere_light_center(light, time),
                 along(along(light.corner, half_u, light.edge_u), half_v, light.edge_v)),
          select(round, light.length_u, half_u + half_v)};
}

/// What is known of ways of so many crossings to any point of a lamp, before they are solved.
template <class F>
struct PaneBounds {
  MaskOf<F> valid;            ///< the point that asks and all of the lamp are outside of the slab
  F entry_least, entry_most;  ///< share of a way's reach along the faces up to where it enters
  F leave_least, leave_most;  ///< the same up to where it leaves
  F reach;                    ///< of the lamp
};

/// lamp: the far point of the sight is its centre.
template <class F>
TYNDALL_INLINE PaneBounds<F> bounds_of(const PaneSight<F>& s, F crossings, const LampBall<F>& lamp) {
  const F near = s.near_gap, close = max(s.far_gap - lamp.reach, F(0.0f)), wide = s.far_gap + lamp.reach;
  const F inside = F(2.0f) * crossings * s.half.height / s.index;
  const F skin = F(1e-5f) * (s.half.side[0] + s.half.side[1] + s.half.height);
  PaneBounds<F> b;
  b.valid = mask_and(less(skin, near), less(F(1.001f) * lamp.reach + skin, s.far_gap));
  const F one = F(1.0f), safe = max(near, F(1e-30f));
  b.entry_least = safe / (safe + wide + inside), b.entry_most = safe / (safe + close);
  b.leave_least = safe / (safe + wide), b.leave_most = one - close / (safe + close + inside);
  b.reach = lamp.reach;
  return b;
}

/// Whether a way with this image of the lamp along an edge may meet the faces. May be yes too often.
template <class F>
TYNDALL_INLINE MaskOf<F> may_meet(const PaneSight<F>& s, const PaneBounds<F>& b, int edge, F image) {
  const F middle = to_image(s, edge, image), low = middle - b.reach, high = middle + b.reach;
  const F half = F(1.0001f) * s.half.side[edge], near = s.near.side[edge];
  const F beyond = mul_add(F(-2.0f) * image, s.half.side[edge], near);
  const auto enters = mask_and(less_equal(near + min(low * b.entry_least, low * b.entry_most), half),
                               less_equal(-half, near + max(high * b.entry_least, high * b.entry_most)));
  const auto leaves = mask_and(less_equal(beyond + min(low * b.leave_least, low * b.leave_most), half),
                               less_equal(-half, beyond + max(high * b.leave_least, high * b.leave_most)));
  return mask_and(enters, leaves);
}

/// Whether a way meets no face that something else touches.
template <class F>
TYNDALL_INLINE MaskOf<F> is_open(const ChainPane<F>& pane, const PaneSight<F>& s, const PaneWord<F>& word) {
  using I = IntOf<F>;
  if (all(equal(pane.closed, I(0)))) return less(F(-1.0f), F(0.0f));
  const auto lower_of = [](I edge) __attribute__((always_inline)) {
    return select(equal(edge, I(0)), I(1), select(equal(edge, I(1)), I(4), I(16)));
  };
  const I first = next_edge<F>(word.across), edges[2] = {first, next_edge<F>(first)};
  const I entry = select(less(F(0.0f), s.near.height), I(2), I(1));
  I met = lower_of(word.across) * select(equal(word.crossings, F(0.0f)), entry, I(3));
  for (int k = 0; k < 2; ++k) {
    const F image = word.image[k];
    const I one = select(less(F(0.0f), image), I(2), select(less(image, F(0.0f)), I(1), I(0)));
    met = met + lower_of(edges[k]) * select(less(F(1.5f), abs(image)), I(3), one);
  }
  return equal(met & pane.closed, I(0));
}

/// Whether a word is among those that are drawn.
template <class F>
TYNDALL_INLINE MaskOf<F> is_looked_for(const ChainPane<F>& pane, const PaneSight<F>& s, const LampBall<F>& lamp,
                                       const PaneWord<F>& word) {
  const PaneBounds<F> bounds = bounds_of(s, word.crossings, lamp);
  const F most = max(abs(word.image[0]), abs(word.image[1]));
  const auto even = less(F(0.0f), parity_sign(word.crossings));
  const auto same_side = mask_or(mask_and(even, s.same), mask_not(mask_or(even, s.same)));
  const auto few = mask_and(less_equal(word.crossings, F(most_crossings)),
                            less_equal(most, select(less(F(0.0f), word.crossings), F(most_images), F(0.0f))));
  const auto meets = mask_and(may_meet(s, bounds, 0, word.image[0]), may_meet(s, bounds, 1, word.image[1]));
  return mask_and(mask_and(mask_and(bounds.valid, same_side), few), mask_and(meets, is_open(pane, s, word)));
}

/// A number of crossings, and the probability with which it is drawn.
template <class F>
struct PaneCrossings {
  F count, probability;
};

/// Draws it about as light does that goes straight: each further reflection at the inside is as much rarer.
template <class F>
TYNDALL_INLINE PaneCrossings<F> draw_crossings(const PaneSight<F>& s, F u) {
  const F height = max(s.near_gap + s.far_gap, F(1e-30f)), x = to_image(s, 0, F(0.0f)), y = to_image(s, 1, F(0.0f));
  const F reflected = fresnel(height / sqrt(mul_add(height, height, mul_add(x, x, y * y))), s.index);
  const F further = min(max(reflected * reflected, F(0.0625f)), F(0.9f));  // for two more crossings
  const F off = select(s.same, mul_add(F(0.5f), reflected, F(0.5f)), F(0.0f));
  const F rest = min(max((F(1.0f) - u) / (F(1.0f) - off), F(1e-6f)), F(1.0f));
  F pairs = F(0.0f), chance = (F(1.0f) - off) * (F(1.0f) - further), left = further;
  for (int k = 2; k <= static_cast<int>(most_crossings) + 1; k += 2) {
    const auto more = less(rest, left);
    pairs = select(more, pairs + F(1.0f), pairs), chance = select(more, chance * further, chance);
    left = left * further;
  }
  const auto none = less(u, off);
  const F through = mul_add(F(2.0f), pairs, select(s.same, F(2.0f), F(1.0f)));
  return {select(none, F(0.0f), through), select(none, off, chance)};
}

/// The words that a point may ask for.
template <class F>
struct PaneWords {
  static constexpr int images = 2 * most_images + 1, room = 3 * images * images;
  F weight[room];
  int across[room], image[room][2];
  PaneCrossings<F> crossings[3];
  int count = 0;
};

/// About what a word brings, over the probability of its crossings. normal: of the surface that asks; 0 in fog.
template <class F>
TYNDALL_INLINE F pane_weight(const PaneSight<F>& s, const PaneWord<F>& word, const PanePlace<F>& normal, F blur) {
  const F outside = max(s.near_gap + s.far_gap, F(1e-30f)), inside = F(2.0f) * word.crossings * s.half.height;
  const F x = to_image(s, 0, word.image[0]), y = to_image(s, 1, word.image[1]);
  const F slope = find_slope(s.index, outside, inside, sqrt(mul_add(x, x, y * y)), 2);
  const PaneSlope<F> at = reach_of(s.index, outside, inside, slope);
  const F gone[2] = {x / at.reach, y / at.reach};
  PaneWay<F> way;
  follow_slope(s, word, at, way);
  const F up = select(less(F(0.0f), s.near.height), -normal.height, normal.height);
  const F cosine =
      mul_add(gone[0], normal.side[0], mul_add(gone[1], normal.side[1], up)) / sqrt(mul_add(slope, slope, F(1.0f)));
  const auto fog = equal(abs(normal.side[0]) + abs(normal.side[1]) + abs(normal.height), F(0.0f));
  const F meets = select(meets_faces(s, word, gone, blur), F(1.0f), F(0.02f));
  return meets * way.share * select(fog, F(1.0f), max(cosine, F(0.02f))) / max(way.spread, F(1e-30f));
}

/// Lists the words of ways that enter at the ends of one edge.
template <class F>
TYNDALL_INLINE void list_words(const ChainPane<F>& pane, const PaneSight<F>& s, const LampBall<F>& lamp,
                               const PanePlace<F>& normal, int across, MaskOf<F> lanes, PaneWords<F>& words) {
  const PaneCrossings<F>& crossings = words.crossings[across];
  const PaneBounds<F> bounds = bounds_of(s, crossings.count, lamp);
  const auto valid = mask_and(mask_and(lanes, bounds.valid), less_equal(crossings.count, F(most_crossings)));
  if (!any(valid)) return;
  const F blur = mul_add(F(0.01f), s.half.side[0] + s.half.side[1], lamp.reach);
  const auto reflected = equal(crossings.count, F(0.0f));
  for (int i = -most_images; i <= most_images; ++i) {
    const F first = F(static_cast<float>(i));
    auto may = mask_and(valid, may_meet(s, bounds, 0, first));
    if (i != 0) may = mask_and_not(may, reflected);
    for (int k = -most_images; k <= most_images && any(may); ++k) {
      const F second = F(static_cast<float>(k));
      auto here = mask_and(may, may_meet(s, bounds, 1, second));
      if (k != 0) here = mask_and_not(here, reflected);
      const PaneWord<F> word{IntOf<F>(across), crossings.count, {first, second}};
      if (any(here)) here = mask_and(here, is_open(pane, s, word));
      if (!any(here)) continue;
      const F weight = pane_weight(s, word, normal, blur) / crossings.probability;
      words.weight[words.count] = select(here, max(weight, F(1e-30f)), F(0.0f));
      words.across[words.count] = across;
      words.image[words.count][0] = i, words.image[words.count][1] = k;
      ++words.count;
    }
  }
}

/// A word, drawn from all that a point may ask for.
template <class F>
struct PaneDrawn {
  PaneWord<F> word;
  MaskOf<F> drawn;  ///< false where there is none
  F probability;
};

template <class F>
TYNDALL_INLINE PaneDrawn<F> take_word(const PaneWords<F>& words, F u) {
  using I = IntOf<F>;
  F total = F(0.0f);
  for (int i = 0; i < words.count; ++i) total = total + words.weight[i];
  PaneDrawn<F> out{{I(0), F(0.0f), {F(0.0f), F(0.0f)}}, less(F(0.0f), total), F(1.0f)};
  F left = u * total, weight = F(1.0f);
  auto open = out.drawn;
  for (int i = 0; i < words.count && any(open); ++i) {
    const auto here = mask_and(open, less(F(0.0f), words.weight[i]));
    const PaneCrossings<F>& crossings = words.crossings[words.across[i]];
    out.word.across = select(here, I(words.across[i]), out.word.across);
    out.word.crossings = select(here, crossings.count, out.word.crossings);
    for (int k = 0; k < 2; ++k)
      out.word.image[k] = select(here, F(static_cast<float>(words.image[i][k])), out.word.image[k]);
    weight = select(here, words.weight[i], weight);
    out.probability = select(here, crossings.probability, out.probability);
    open = mask_and_not(open, mask_and(here, less(left, words.weight[i])));
    left = left - words.weight[i];
  }
  out.probability = out.probability * weight / max(total, F(1e-37f));
  return out;
}

/// Draws a word for a point. normal: of the surface there; 0 in fog. u: two random numbers.
template <class F>
TYNDALL_INLINE PaneDrawn<F> draw_pane_word(const ChainPane<F>& pane, Vec3<F> point, Vec3<F> normal,
                                           const LampBall<F>& lamp, Pair<F> u, MaskOf<F> lanes) {
  PaneWords<F> words;
  const F edges[3] = {dot(pane.row[0], normal), dot(pane.row[1], normal), dot(pane.row[2], normal)};
  for (int across = 0; across < 3; ++across) {
    const IntOf<F> edge(across);
    const PaneSight<F> s = sight_of(pane, point, lamp.center, edge);
    words.crossings[across] = draw_crossings(s, u.x);
    list_words(pane, s, lamp, framed<F>(edges, edge), across, lanes, words);
  }
  return take_word(words, u.y);
}

/// Where a lamp sees the point that asks, by way of the pane: within this ball. It takes the place of the ball where
/// points of a lamp are drawn. s: its far point does not matter.
template <class F>
TYNDALL_INLINE ChainBall<F> seen_by_pane(const ChainPane<F>& pane, const PaneSight<F>& s, const PaneWord<F>& word) {
  const F height = copy_sign(F(1.0f), s.near.height) *
                   mul_add(F(2.0f) * s.half.height, word.crossings - F(1.0f), abs(s.near.height));
  F side[2];
  for (int k = 0; k < 2; ++k)
    side[k] = parity_sign(word.image[k]) * mul_add(F(-2.0f) * word.image[k], s.half.side[k], s.near.side[k]);
  const IntOf<F> first = next_edge<F>(word.across);
  ChainBall<F> b{};
  b.radius = F(2.0f) * word.crossings * s.half.height;
  b.center = zero3<F>();
  for (int k = 0; k < 3; ++k) {
    const IntOf<F> edge(k);
    const F place = select(equal(edge, word.across), -parity_sign(word.crossings) * height,
                           select(equal(edge, first), side[0], side[1]));
    b.center = along(b.center, place - pane.offset[k], pane.row[k]);
  }
  return b;
}

/// The word of a path that met a pane by chance. direction: in which it left the pane.
template <class F>
TYNDALL_INLINE PaneWord<F> pane_word_of(const ChainPane<F>& pane, SpecularHistory<F> met, Vec3<F> direction) {
  const F count[3] = {from_int<F>(met.template at_faces<0>()), from_int<F>(met.template at_faces<1>()),
                      from_int<F>(met.template at_faces<2>())};
  const F rises[3] = {dot(pane.row[0], direction), dot(pane.row[1], direction), dot(pane.row[2], direction)};
  PaneWord<F> word;
  word.across = met.first_edge();
  const PanePlace<F> counts = framed<F>(count, word.across), way = framed<F>(rises, word.across);
  word.crossings = counts.height - F(1.0f);
  for (int k = 0; k < 2; ++k) word.image[k] = copy_sign(counts.side[k], parity_sign(counts.side[k]) * way.side[k]);
  return word;
}

/// What pair k of a pane and a lamp is worth at a point, > 0: as much as the lamp itself where the straight way to it
/// meets the ball around the pane, less elsewhere, where reflections may still bring light.
template <class F>
TYNDALL_INLINE F pane_worth(const ChainView& c, int k, Vec3<F> point) {
  const int ball = c.ball[k];
  const auto column = [&](const float* const* v, int i) { return splat<F>(Vec3f{v[0][i], v[1][i], v[2][i]}); };
  const Vec3<F> way = column(c.choice.center, k) - point, arm = column(c.center, ball) - point;
  const F distance2 = dot(way, way), reach2 = splat<F>(c.choice.reach2[k]);
  const F share = min(max(dot(arm, way) / max(distance2, F(1e-30f)), F(0.0f)), F(1.0f));
  const Vec3<F> off = along(arm, -share, way);
  const F radius = splat<F>(c.radius[ball]) + sqrt(reach2);
  const F part = select(less(dot(off, off), radius * radius), F(1.0f), F(0.15f));
  return part * splat<F>(c.choice.power[k]) / max(distance2, reach2);
}

/// What pair k of a ball, mirror or pane and a lamp is worth at a point, > 0. See light_worth() of lights.
template <class F>
TYNDALL_INLINE F light_worth(const ChainView& c, int k, Vec3<F> point) {
  if (c.ball[k] < c.first_mirror) return light_worth(c.choice, k, point);
  return c.ball[k] < c.first_pane ? mirror_worth(c, k, point) : pane_worth(c, k, point);
}

}  // namespace tyndall

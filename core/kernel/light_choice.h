#pragma once
#include "core/base/vec.h"
#include "core/kernel/scene_view.h"

/// Which light a path asks for, and with which probability.
namespace tyndall {

/// How much light k roughly contributes at a point: its power over the squared distance, which counts as no smaller
/// than the squared radius of the light.
template <class F>
TYNDALL_INLINE F light_worth(const LightView& l, int k, Vec3<F> point) {
  const Vec3<F> way = splat<F>(Vec3f{l.center[0][k], l.center[1][k], l.center[2][k]}) - point;
  return splat<F>(l.power[k]) / max(dot(way, way), splat<F>(l.reach2[k]));
}

// The next functions choose among lights, or among pairs of a ball or mirror and a light: among what `view` has. (They
// are not given closures, which would keep the path in memory.)
TYNDALL_INLINE const LightView& choice_of(const LightView& view) { return view; }
TYNDALL_INLINE const LightView& choice_of(const ChainView& view) { return view.choice; }

template <class F>
TYNDALL_INLINE F total_worth(const auto& view, Vec3<F> point) {
  F sum = F(0.0f);
  for (int k = 0; k < choice_of(view).count; ++k) sum = sum + light_worth(view, k, point);
  return sum;
}

/// A light for each lane, and the probability of that choice.
template <class F>
struct LightChoice {
  IntOf<F> light;
  F probability;
};

/// Chooses a light for a point by u in [0, 1): in proportion to light_worth() if there are few lights, in proportion to
/// their power (by Vose's alias table) if there are more than most_lights_by_contribution.
template <class F>
TYNDALL_INLINE LightChoice<F> choose_light(const auto& view, Vec3<F> point, F u) {
  using I = IntOf<F>;
  const LightView& l = choice_of(view);
  if (l.count == 1) return {I(0), F(1.0f)};
  if (l.count <= most_lights_by_contribution) {
    const F total = total_worth(view, point);
    LightChoice<F> choice{I(l.count - 1), F(0.0f)};
    F left = u * total, worth = F(0.0f);
    MaskOf<F> open = less(F(-1.0f), F(0.0f));
    for (int k = 0; k < l.count; ++k) {
      worth = light_worth(view, k, point);
      const auto here = k + 1 < l.count ? mask_and(open, less(left, worth)) : open;
      choice.light = select(here, I(k), choice.light);
      choice.probability = select(here, worth / total, choice.probability);
      open = mask_and_not(open, here);
      left = left - worth;
    }
    return choice;
  }
  const F scaled = u * splat<F>(static_cast<float>(l.count));
  const F slot = min(floor(scaled), splat<F>(static_cast<float>(l.count - 1)));
  const I first = to_int(slot);
  const I light = select(less(scaled - slot, gather<F>(l.keep, first)), first, gather_int<F>(l.alias, first));
  return {light, gather<F>(l.probability, light)};
}

/// Probability with which choose_light() takes `light` at a point.
template <class F>
TYNDALL_INLINE F choice_probability(const auto& view, Vec3<F> point, IntOf<F> light) {
  const LightView& l = choice_of(view);
  if (l.count == 1) return F(1.0f);
  if (l.count > most_lights_by_contribution) return gather<F>(l.probability, light);
  F total = F(0.0f), own = F(0.0f);
  for (int k = 0; k < l.count; ++k) {
    const F worth = light_worth(view, k, point);
    own = select(equal(light, IntOf<F>(k)), worth, own);
    total = total + worth;
  }
  return own / total;
}

}  // namespace tyndall

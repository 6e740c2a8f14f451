#pragma once
#include "core/base/vec.h"
#include "core/trace/scene_view.h"

/// Chooses the light that a path samples, and gives the probability of the choice.
namespace tyndall {

/// Estimated contribution of light k at a point: its power over the squared distance, where distances below the light's
/// radius count as the radius.
template <class F>
TYNDALL_INLINE F light_worth(const LightView& l, int k, Vec3<F> point) {
  const Vec3<F> way = splat<F>(Vec3f{l.center[0][k], l.center[1][k], l.center[2][k]}) - point;
  return splat<F>(l.power[k]) / max(dot(way, way), splat<F>(l.reach2[k]));
}

// The functions below choose among lights (LightView) or among pairs of an object and a light (SpecularView). They take
// views instead of closures, because closures would keep the path in memory.
TYNDALL_INLINE const LightView& choice_of(const LightView& view) { return view; }
TYNDALL_INLINE const LightView& choice_of(const SpecularView& view) { return view.choice; }

template <class F>
TYNDALL_INLINE F total_worth(const auto& view, Vec3<F> point) {
  F sum = F(0.0f);
  for (int k = 0; k < choice_of(view).count; ++k) sum = sum + light_worth(view, k, point);
  return sum;
}

/// A light for each lane, and the probability with which it was chosen.
template <class F>
struct LightChoice {
  IntOf<F> light;
  F probability;
};

/// The probabilities of choosing each of two sibling nodes at a point: in proportion to their estimated contributions,
/// as light_worth() estimates those of single lights.
template <class F>
TYNDALL_INLINE Pair<F> probabilities_of_pair(const LightTreeView& t, IntOf<F> first, Vec3<F> point) {
  const auto worth = [&](IntOf<F> node) {
    const Vec3<F> center{gather<F>(t.center[0], node), gather<F>(t.center[1], node), gather<F>(t.center[2], node)};
    const Vec3<F> to_node = center - point;
    return gather<F>(t.power, node) / max(dot(to_node, to_node), gather<F>(t.reach2, node)) + F(1e-30f);
  };
  const F a = worth(first), b = worth(first + IntOf<F>(1)), sum = a + b;
  return {a / sum, b / sum};
}

/// Descends the tree from the root, choosing one of two children at random at each node.
template <class F>
TYNDALL_INLINE LightChoice<F> choose_in_tree(const LightTreeView& t, Vec3<F> point, F u) {
  using I = IntOf<F>;
  I node = I(0);
  F probability = F(1.0f);
  for (;;) {
    const I child = gather<F>(t.child, node);
    const auto inner = less_equal(I(0), child);
    if (!any(inner)) return {I(-1) - child, probability};
    const I pair = select(inner, child, I(0));
    const Pair<F> probabilities = probabilities_of_pair(t, pair, point);
    const auto first = less(u, probabilities.x);
    const F chosen = select(first, probabilities.x, probabilities.y),
            rest = select(first, u, u - probabilities.x) / chosen;
    probability = select(inner, probability * chosen, probability);
    u = select(inner, min(rest, F(0.99999994f)), u);
    node = select(inner, select(first, pair, pair + I(1)), node);
  }
}

/// Probability with which choose_in_tree() takes `light`: the product over its ancestors, from its leaf up.
template <class F>
TYNDALL_INLINE F probability_in_tree(const LightTreeView& t, Vec3<F> point, IntOf<F> light) {
  using I = IntOf<F>;
  I node = gather<F>(t.leaf, light);
  F probability = F(1.0f);
  for (;;) {
    const auto below = less(I(0), node);
    if (!any(below)) return probability;
    const I side = node & I(1), pair = select(below, node - side, I(0));
    const Pair<F> probabilities = probabilities_of_pair(t, pair, point);
    probability = select(below, probability * select(equal(side, I(0)), probabilities.x, probabilities.y), probability);
    node = select(below, gather<F>(t.parent, node), I(0));
  }
}

/// Chooses a light for a point by u in [0, 1): in proportion to light_worth(), or by the tree of lights if there are
/// more than max_lights_by_contribution.
template <class F>
TYNDALL_INLINE LightChoice<F> choose_light(const auto& view, Vec3<F> point, F u) {
  using I = IntOf<F>;
  const LightView& l = choice_of(view);
  if (l.count == 1) return {I(0), F(1.0f)};
  if (l.count <= max_lights_by_contribution) {
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
  return choose_in_tree(l.tree, point, u);
}

/// Probability with which choose_light() takes `light` at a point.
template <class F>
TYNDALL_INLINE F choice_probability(const auto& view, Vec3<F> point, IntOf<F> light) {
  const LightView& l = choice_of(view);
  if (l.count == 1) return F(1.0f);
  if (l.count > max_lights_by_contribution) return probability_in_tree(l.tree, point, light);
  F total = F(0.0f), own = F(0.0f);
  for (int k = 0; k < l.count; ++k) {
    const F worth = light_worth(view, k, point);
    own = select(equal(light, IntOf<F>(k)), worth, own);
    total = total + worth;
  }
  return own / total;
}

}  // namespace tyndall

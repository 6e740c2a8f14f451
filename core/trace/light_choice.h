#pragma once
#include "core/base/sampling.h"
#include "core/shapes/outline.h"
#include "core/trace/scene_view.h"

/// The lights of a scene as lanes read them, each lane another one, and the choice of the light that a path samples.
namespace tyndall {

/// One light per lane, read from the columns of Lights. With one light in the scene they are read once for all lanes.
template <class F>
struct LightColumns {
  IntOf<F> kind;
  Vec3<F> corner, edge_u, edge_v, normal;
  F length_u, length_v, area;
};

template <class F>
TYNDALL_INLINE LightColumns<F> load_light(const Lights& l, IntOf<F> k) {
  const auto light = [&](const auto& value) __attribute__((always_inline)) {
    return LightColumns<F>{value(l.kind),   value(l.corner),   value(l.edge_u),   value(l.edge_v),
                           value(l.normal), value(l.length_u), value(l.length_v), value(l.area)};
  };
  if (l.count() == 1)
    return light([](const auto& column) __attribute__((always_inline)) { return splat<F>(column[0]); });
  return light([&](const auto& column) __attribute__((always_inline)) { return lookup<F>(column, l.count(), k); });
}

/// Where u in [0, 1)² lies on the flat light k, as fractions of its edges, uniformly by area. kind: of the light.
template <class F>
TYNDALL_INLINE Pair<F> on_flat_light(const auto& s, IntOf<F> k, IntOf<F> kind, Pair<F> u) {
  if (!s.has_outlined_lights()) return u;
  const auto triangle = equal(kind, IntOf<F>(Lights::triangle)), ring = equal(kind, IntOf<F>(Lights::ring));
  const Pair<F> folded = in_triangle(u), round = in_ring(lookup<F>(s.lights.inner, s.lights.count(), k), u);
  return {select(triangle, folded.x, select(ring, round.x, u.x)),
          select(triangle, folded.y, select(ring, round.y, u.y))};
}

/// Estimated contribution of light k at a point: its power over the squared distance, where distances below the light's
/// radius count as the radius.
template <class F>
TYNDALL_INLINE F light_worth(const Lights& l, int k, Vec3<F> point) {
  const Vec3<F> way = splat<F>(l.center[k]) - point;
  return splat<F>(l.power[k]) / max(dot(way, way), splat<F>(l.reach2[k]));
}

// The functions below choose among lights (Lights) or among pairs of an object and a light (SpecularPairs). They take
// views instead of closures, because closures would keep the path in memory.
TYNDALL_INLINE const Lights& choice_of(const Lights& view) { return view; }
TYNDALL_INLINE const Lights& choice_of(const SpecularPairs& view) { return view.choice; }

template <class F>
TYNDALL_INLINE F total_worth(const auto& view, Vec3<F> point) {
  F sum = F(0.0f);
  for (int k = 0; k < choice_of(view).count(); ++k) sum = sum + light_worth(view, k, point);
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
TYNDALL_INLINE Pair<F> probabilities_of_pair(const LightTree& t, IntOf<F> first, Vec3<F> point) {
  const auto worth = [&](IntOf<F> node) {
    const Vec3<F> center{gather<F>(t.center.x, node), gather<F>(t.center.y, node), gather<F>(t.center.z, node)};
    const Vec3<F> to_node = center - point;
    return gather<F>(t.power, node) / max(dot(to_node, to_node), gather<F>(t.reach2, node)) + F(1e-30f);
  };
  const F a = worth(first), b = worth(first + IntOf<F>(1)), sum = a + b;
  return {a / sum, b / sum};
}

/// Descends the tree from the root, choosing one of two children at random at each node.
template <class F>
TYNDALL_INLINE LightChoice<F> choose_in_tree(const LightTree& t, Vec3<F> point, F u) {
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
TYNDALL_INLINE F probability_in_tree(const LightTree& t, Vec3<F> point, IntOf<F> light) {
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
  const Lights& l = choice_of(view);
  if (l.count() == 1) return {I(0), F(1.0f)};
  if (l.count() <= max_lights_by_contribution) {
    const F total = total_worth(view, point);
    LightChoice<F> choice{I(l.count() - 1), F(0.0f)};
    F left = u * total, worth = F(0.0f);
    MaskOf<F> open = less(F(-1.0f), F(0.0f));
    for (int k = 0; k < l.count(); ++k) {
      worth = light_worth(view, k, point);
      const auto here = k + 1 < l.count() ? mask_and(open, less(left, worth)) : open;
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
  const Lights& l = choice_of(view);
  if (l.count() == 1) return F(1.0f);
  if (l.count() > max_lights_by_contribution) return probability_in_tree(l.tree, point, light);
  F total = F(0.0f), own = F(0.0f);
  for (int k = 0; k < l.count(); ++k) {
    const F worth = light_worth(view, k, point);
    own = select(equal(light, IntOf<F>(k)), worth, own);
    total = total + worth;
  }
  return own / total;
}

}  // namespace tyndall

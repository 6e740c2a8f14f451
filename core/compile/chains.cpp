#include "core/compile/chains.h"

#include "core/compile/columns.h"
#include "core/compile/crowds.h"
#include "core/compile/lights.h"
#include "core/compile/mirrors.h"
#include "core/compile/panes.h"
#include "core/compile/sight.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double smallness = 0.25;  // most that a lamp's reach may be over its distance, or over the ball around it
constexpr double smallness_for_glass = 0.15;  // the same for light through solid glass from outside
constexpr std::size_t most_pairs = 256;
constexpr std::size_t most_sights = 1 << 18;  // pairs times shapes up to which it is found out what balls see of lamps
constexpr double like_outside = 1e-3;         // an index counts as that of the outside if it is this close to 1

/// A sphere of glass or of metal without fuzz.
struct Candidate {
  RoundBody body;
  double index;       // refractive index within over that outside; 0: metal
  std::size_t shape;  // index into Flattened::shapes
  int inside = -1;    // the smallest candidate around the same centre that holds this one; -1: none
  int holds = -1;     // the largest candidate around the same centre that this one holds; -1: none
};

bool concentric(const RoundBody& a, const RoundBody& b) {
  const double slack = 1e-7 * std::max(a.radius, b.radius);
  return length(a.center - b.center) <= slack && length(a.way - b.way) <= slack;
}

/// Whether another sphere is in the same place. Which of the two a ray meets is decided by rounding.
bool is_doubled(const Flattened& flat, std::size_t own, const RoundBody& body) {
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const auto* sphere = std::get_if<Sphere<>>(&flat.shapes[i].shape);
    if (!sphere || i == own) continue;
    const RoundBody other = round_body(*sphere, flat.shapes[i].placement);
    if (concentric(body, other) && std::abs(body.radius - other.radius) < 1e-6 * body.radius) return true;
  }
  return false;
}

std::vector<Candidate> list_candidates(const Flattened& flat, const Scene& scene) {
  std::vector<Candidate> list;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const auto* sphere = std::get_if<Sphere<>>(&flat.shapes[i].shape);
    if (!sphere) continue;
    const Material& material = scene.materials[static_cast<std::size_t>(flat.shapes[i].material)];
    const double own_index = boundary_index(material.kind);
    if (own_index == 0 && !is_mirror(material.kind)) continue;
    const double index = sphere->radius > 0 || own_index == 0 ? own_index : 1 / own_index;
    const RoundBody body = round_body(*sphere, flat.shapes[i].placement);
    if (!is_doubled(flat, i, body)) list.push_back({body, index, i});
  }
  return list;
}

void nest(std::vector<Candidate>& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].index == 0) continue;
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (list[k].index == 0 || !concentric(list[i].body, list[k].body)) continue;
      const double radius = list[k].body.radius, own = list[i].body.radius;
      int& around = list[i].inside;
      if (radius > own && (around < 0 || radius < list[static_cast<std::size_t>(around)].body.radius))
        around = static_cast<int>(k);
      int& within = list[i].holds;
      if (radius < own && (within < 0 || radius > list[static_cast<std::size_t>(within)].body.radius))
        within = static_cast<int>(k);
    }
  }
}

struct BallAndLight {
  int ball;  // index into the candidates, or behind them into the flat mirrors, or behind those into the panes
  int light;
  double worth;
};

/// How much light a lamp sends to a ball, roughly, by which pairs are chosen. 0: the lamp is so large as seen from the
/// ball that paths find it by chance well enough.
double worth_of(const RoundBody& body, bool solid_glass, const Lights& lights, std::size_t k, Vec3d origin) {
  const Vec3d lamp = Vec3d{lights.center[0][k], lights.center[1][k], lights.center[2][k]} + origin;
  const double reach = std::sqrt(static_cast<double>(lights.reach2[k])) + 0.5 * length(body.way);
  const double apart = length(lamp - (body.center + 0.5 * body.way)), distance = std::max(apart, body.radius);
  const bool through_glass = solid_glass && apart > body.radius;
  if (reach > (through_glass ? smallness_for_glass : smallness) * distance) return 0;
  const double share = body.radius / distance;
  return static_cast<double>(lights.power[k]) * share * share;
}

/// Whether what is within a shell is not what is around it. Such shells are left to chance: the turn of a way through
/// them may have more than one least or greatest value, and chain_turn.h would then miss some of the ways.
bool is_filled_shell(const std::vector<Candidate>& list, const Candidate& outer) {
  if (outer.holds < 0) return false;
  return std::abs(outer.index * list[static_cast<std::size_t>(outer.holds)].index - 1) > like_outside;
}

/// All that chains may go by, and where their light shows.
struct Found {
  std::vector<Candidate> balls;
  std::vector<FlatMirror> mirrors;
  std::vector<Pane> panes;
  std::vector<Receiver> receivers;
};

Found look_for_all(const Flattened& flat, const Scene& scene) {
  const std::vector<Flat> flats = list_flats(flat);
  Found found{list_candidates(flat, scene), list_flat_mirrors(flat, flats, scene), list_panes(flat, flats, scene), {}};
  nest(found.balls);
  if (!found.mirrors.empty()) found.receivers = list_receivers(flat, scene);
  return found;
}

std::vector<BallAndLight> list_pairs(const Found& found, const RenderScene& compiled) {
  const std::vector<Candidate>& list = found.balls;
  const std::vector<FlatMirror>& mirrors = found.mirrors;
  std::vector<BallAndLight> pairs;
  const auto add = [&](std::size_t ball, const auto& worth_of_light) {
    for (std::size_t k = 0; k < compiled.lights.kind.size(); ++k) {
      const double worth = worth_of_light(k);
      if (worth > 0) pairs.push_back({static_cast<int>(ball), static_cast<int>(k), worth});
    }
  };
  for (std::size_t b = 0; b < list.size(); ++b)
    if (list[b].inside < 0 && !is_filled_shell(list, list[b]))
      add(b, [&](std::size_t k) {
        return worth_of(list[b].body, list[b].index != 0 && list[b].holds < 0, compiled.lights, k, compiled.origin);
      });
  for (std::size_t b = 0; b < mirrors.size(); ++b)
    add(list.size() + b,
        [&](std::size_t k) { return worth_of(mirrors[b], compiled.lights, k, compiled.origin, found.receivers); });
  for (std::size_t b = 0; b < found.panes.size(); ++b)
    add(list.size() + mirrors.size() + b,
        [&](std::size_t k) { return worth_of(found.panes[b], compiled.lights, k, compiled.origin); });
  if (pairs.size() > most_pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const BallAndLight& a, const BallAndLight& b) { return a.worth > b.worth; });
    pairs.resize(most_pairs);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const BallAndLight& a, const BallAndLight& b) { return a.ball < b.ball; });
  }
  return pairs;
}

/// Takes those pairs of a ball and a lamp for less whose ball does not see the whole lamp. The chance of a pair should
/// go with the root of its light's mean square, and the light that is left falls on a share of the places only.
void weigh_by_sight(const Flattened& flat, const Found& found, const RenderScene& compiled,
                    std::vector<BallAndLight>& pairs) {
  if (pairs.size() * flat.shapes.size() > most_sights) return;
  const Obstacles obstacles = list_obstacles(flat);
  for (BallAndLight& pair : pairs) {
    const auto ball = static_cast<std::size_t>(pair.ball);
    if (ball >= found.balls.size()) continue;
    pair.worth *= std::sqrt(visible_share(obstacles, compiled.lights, static_cast<std::size_t>(pair.light),
                                          compiled.origin, found.balls[ball].body));
  }
}

class Filler {
 public:
  Filler(const Flattened& flat, const RenderScene& compiled) : flat_(flat), compiled_(compiled) {
    std::int32_t element = 0;
    for (const PlacedShape& shape : flat.shapes) {
      first_element_.push_back(element);
      element += std::holds_alternative<Box<>>(shape.shape) ? 6 : 1;
    }
    out.ball_of.assign(static_cast<std::size_t>(compiled.elements.count()), -1);
  }

  void add_ball(const std::vector<Candidate>& list, const Candidate& outer) {
    const Candidate* inner = outer.holds < 0 ? nullptr : &list[static_cast<std::size_t>(outer.holds)];
    const int ball = static_cast<int>(out.radius.size());
    push(out.center, outer.body.center - compiled_.origin);
    push(out.move, outer.body.way);
    out.radius.push_back(static_cast<float>(outer.body.radius));
    out.index.push_back(static_cast<float>(outer.index));
    out.inner_radius.push_back(inner ? static_cast<float>(inner->body.radius) : 0);
    out.inner_index.push_back(inner ? static_cast<float>(outer.index * inner->index) : 1);
    out.outer.push_back(name(outer, ball, 0));
    out.inner.push_back(inner ? name(*inner, ball, 1) : out.outer.back());
    out.crowded.push_back(is_crowded(flat_, outer.body, {outer.shape, inner ? inner->shape : outer.shape}) ? 1 : 0);
    out.pair_of.resize(out.pair_of.size() + compiled_.lights.kind.size(), -1);
    ++out.first_mirror, ++out.first_pane;
  }

  /// After all balls.
  void add_mirror(const FlatMirror& mirror) {
    add_flat(mirror.middle, 0, 0, first_element_[mirror.shape] + mirror.face, 1);
    append_numbers(mirror, compiled_.origin, out.mirrors);
    ++out.first_pane;
  }

  /// After all mirrors.
  void add_pane(const Pane& pane) {
    const double radius = std::hypot(pane.half[0], pane.half[1], pane.half[2]);
    add_flat(pane.middle, radius, pane.index, first_element_[pane.shape], 6);
    append_numbers(pane, compiled_.origin, out.panes);
  }

  void add_pair(const BallAndLight& pair) {
    const std::size_t ball = out.radius.size() - 1;
    out.pair_of[ball * compiled_.lights.kind.size() + static_cast<std::size_t>(pair.light)] =
        static_cast<std::int32_t>(out.ball.size());
    out.ball.push_back(static_cast<std::int32_t>(ball));
    out.light.push_back(pair.light);
    out.choice.kind.push_back(Lights::sphere);
    const auto k = static_cast<std::size_t>(pair.light);
    const bool by_flat = static_cast<int>(ball) >= out.first_mirror;
    out.choice.power.push_back(by_flat ? compiled_.lights.power[k] : static_cast<float>(pair.worth));
    out.choice.reach2.push_back(by_flat ? compiled_.lights.reach2[k] : out.radius[ball] * out.radius[ball]);
    for (int i = 0; i < 3; ++i)
      out.choice.center[i].push_back(by_flat ? compiled_.lights.center[i][k]
                                             : out.center[i][ball] + 0.5f * out.move[i][ball]);
  }

  Chains out;

 private:
  void add_flat(Vec3d middle, double radius, double index, std::int32_t element, int faces) {
    const int ball = static_cast<int>(out.radius.size());
    push(out.center, middle - compiled_.origin);
    push(out.move, {});
    out.radius.push_back(static_cast<float>(radius)), out.index.push_back(static_cast<float>(index));
    out.inner_radius.push_back(0), out.inner_index.push_back(1);
    out.outer.push_back(element), out.inner.push_back(element), out.crowded.push_back(0);
    std::fill_n(out.ball_of.begin() + element, faces, 2 * ball);
    out.pair_of.resize(out.pair_of.size() + compiled_.lights.kind.size(), -1);
  }

  std::int32_t name(const Candidate& sphere, int ball, int inner) {
    const std::int32_t element = first_element_[sphere.shape];
    out.ball_of[static_cast<std::size_t>(element)] = 2 * ball + inner;
    return element;
  }

  const Flattened& flat_;
  const RenderScene& compiled_;
  std::vector<std::int32_t> first_element_;  // of each shape
};

}  // namespace

Chains find_chains(const Flattened& flat, const Scene& scene, const RenderScene& compiled) {
  if (!needs_trait<&BsdfTraits::diffuse>(compiled.needs) && !compiled.needs.media) return {};
  const Found found = look_for_all(flat, scene);
  std::vector<BallAndLight> pairs = list_pairs(found, compiled);
  if (pairs.empty()) return {};
  weigh_by_sight(flat, found, compiled, pairs);
  Filler filler(flat, compiled);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto ball = static_cast<std::size_t>(pairs[i].ball);
    const std::size_t first_mirror = found.balls.size(), first_pane = first_mirror + found.mirrors.size();
    if (i == 0 || pairs[i].ball != pairs[i - 1].ball) {
      if (ball < first_mirror)
        filler.add_ball(found.balls, found.balls[ball]);
      else if (ball < first_pane)
        filler.add_mirror(found.mirrors[ball - first_mirror]);
      else
        filler.add_pane(found.panes[ball - first_pane]);
    }
    filler.add_pair(pairs[i]);
  }
  build_light_tree(filler.out.choice);
  return std::move(filler.out);
}

}  // namespace tyndall

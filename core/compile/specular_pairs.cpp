#include "core/compile/specular_pairs.h"

#include "core/compile/columns.h"
#include "core/compile/flat_objects.h"
#include "core/compile/overlap.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double smallness = 0.25;  // most that a light's reach may be over its distance, or over the sphere around it
constexpr double smallness_for_glass = 0.15;  // the same for light through solid glass from outside
constexpr std::size_t max_pairs = 256;
constexpr std::size_t max_visibility_tests =
    1 << 18;                           // pairs times shapes up to which it is found out what spheres see of lights
constexpr double like_outside = 1e-3;  // an index counts as that of the outside if it is this close to 1

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
  return length(a.center - b.center) <= slack && length(a.motion - b.motion) <= slack;
}

/// Whether another sphere is at the same place, so that rounding decides which of the two a ray hits.
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

struct SpecularPair {
  int sphere;  // index into the candidates, or behind them into the flat mirrors, or behind those into the slabs
  int light;   // -1: the sun
  double worth;
};

/// Returns the worth of a pair of a sphere and a light, >= 0, roughly the power that the light sends to the sphere:
/// pairs are chosen by it. 0: the light is so large as seen from the sphere that BSDF sampling finds it well enough.
double worth_of(const RoundBody& body, bool solid_glass, const Lights& lights, std::size_t k, Vec3d origin) {
  const Vec3d light = Vec3d{lights.center[0][k], lights.center[1][k], lights.center[2][k]} + origin;
  const double reach = std::sqrt(static_cast<double>(lights.reach2[k])) + 0.5 * length(body.motion);
  const double apart = length(light - (body.center + 0.5 * body.motion)), distance = std::max(apart, body.radius);
  const bool through_glass = solid_glass && apart > body.radius;
  if (reach > (through_glass ? smallness_for_glass : smallness) * distance) return 0;
  const double fraction = body.radius / distance;
  return static_cast<double>(lights.power[k]) * fraction * fraction;
}

/// Whether the inside of a shell differs from its outside. Such shells are left to BSDF sampling: the deflection of a
/// path through them may have more than one minimum or maximum, so that specular_deflection.h would miss some paths.
bool is_filled_shell(const std::vector<Candidate>& list, const Candidate& outer) {
  if (outer.holds < 0) return false;
  return std::abs(outer.index * list[static_cast<std::size_t>(outer.holds)].index - 1) > like_outside;
}

/// All specular objects, and the receivers on which their light shows.
struct Found {
  std::vector<Candidate> spheres;
  std::vector<FlatMirror> mirrors;
  std::vector<Slab> slabs;
  std::vector<Receiver> receivers;
};

Found look_for_all(const Flattened& flat, const Scene& scene) {
  const std::vector<Flat> flats = list_flats(flat);
  Found found{list_candidates(flat, scene), list_flat_mirrors(flat, flats, scene), list_slabs(flat, flats, scene), {}};
  nest(found.spheres);
  if (!found.mirrors.empty()) found.receivers = list_receivers(flat, scene);
  return found;
}

/// The irradiance by the sun of the sky's picture; 0 if it has none.
double irradiance_of_sun(const SkyColumns& sky) {
  if (!sky.is_sampled() || sky.distribution->sun.tangent == 0) return 0;
  return sky.distribution->sun.irradiance * static_cast<double>(sky.scale);
}

std::vector<SpecularPair> list_pairs(const Found& found, const RenderScene& compiled) {
  const std::vector<Candidate>& list = found.spheres;
  const std::vector<FlatMirror>& mirrors = found.mirrors;
  std::vector<SpecularPair> pairs;
  const auto add = [&](std::size_t sphere, const auto& worth_of_light) {
    for (std::size_t k = 0; k < compiled.lights.kind.size(); ++k) {
      const double worth = worth_of_light(k);
      if (worth > 0) pairs.push_back({static_cast<int>(sphere), static_cast<int>(k), worth});
    }
  };
  const double sun = irradiance_of_sun(compiled.sky);
  for (std::size_t b = 0; b < list.size(); ++b)
    if (list[b].inside < 0 && !is_filled_shell(list, list[b])) {
      add(b, [&](std::size_t k) {
        return worth_of(list[b].body, list[b].index != 0 && list[b].holds < 0, compiled.lights, k, compiled.origin);
      });
      const double radius = list[b].body.radius;
      if (sun > 0) pairs.push_back({static_cast<int>(b), -1, sun * radius * radius});
    }
  for (std::size_t b = 0; b < mirrors.size(); ++b)
    add(list.size() + b,
        [&](std::size_t k) { return worth_of(mirrors[b], compiled.lights, k, compiled.origin, found.receivers); });
  for (std::size_t b = 0; b < found.slabs.size(); ++b)
    add(list.size() + mirrors.size() + b,
        [&](std::size_t k) { return worth_of(found.slabs[b], compiled.lights, k, compiled.origin); });
  if (pairs.size() > max_pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const SpecularPair& a, const SpecularPair& b) { return a.worth > b.worth; });
    pairs.resize(max_pairs);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const SpecularPair& a, const SpecularPair& b) { return a.sphere < b.sphere; });
  }
  return pairs;
}

/// Lowers the worth of pairs whose sphere does not see the whole light. The probability of a pair should be
/// proportional to the root of its light's mean square, and the remaining light reaches a fraction of the places only.
void weigh_by_visibility(const Flattened& flat, const Found& found, const RenderScene& compiled,
                         std::vector<SpecularPair>& pairs) {
  if (pairs.size() * flat.shapes.size() > max_visibility_tests) return;
  const Obstacles obstacles = list_obstacles(flat);
  for (SpecularPair& pair : pairs) {
    const auto sphere = static_cast<std::size_t>(pair.sphere);
    if (sphere >= found.spheres.size() || pair.light < 0) continue;
    pair.worth *= std::sqrt(visible_fraction(obstacles, compiled.lights, static_cast<std::size_t>(pair.light),
                                             compiled.origin, found.spheres[sphere].body));
  }
}

class Filler {
 public:
  Filler(const Flattened& flat, const RenderScene& compiled)
      : flat_(flat), compiled_(compiled), first_element_(first_elements(flat)) {
    out.sphere_of.assign(static_cast<std::size_t>(compiled.elements.count()), -1);
  }

  void add_sphere(const std::vector<Candidate>& list, const Candidate& outer) {
    const Candidate* inner = outer.holds < 0 ? nullptr : &list[static_cast<std::size_t>(outer.holds)];
    const int sphere = static_cast<int>(out.radius.size());
    push(out.center, outer.body.center - compiled_.origin);
    push(out.move, outer.body.motion);
    out.radius.push_back(static_cast<float>(outer.body.radius));
    out.index.push_back(static_cast<float>(outer.index));
    out.inner_radius.push_back(inner ? static_cast<float>(inner->body.radius) : 0);
    out.inner_index.push_back(inner ? static_cast<float>(outer.index * inner->index) : 1);
    out.outer.push_back(name(outer, sphere, 0));
    out.inner.push_back(inner ? name(*inner, sphere, 1) : out.outer.back());
    out.overlapped.push_back(is_overlapped(flat_, outer.body, {outer.shape, inner ? inner->shape : outer.shape}) ? 1
                                                                                                                 : 0);
    out.pair_of.resize(out.pair_of.size() + compiled_.lights.kind.size(), -1);
    ++out.first_mirror, ++out.first_slab;
  }

  /// After all spheres.
  void add_mirror(const FlatMirror& mirror) {
    add_flat(mirror.middle, 0, 0, first_element_[mirror.shape] + mirror.face, 1);
    append_numbers(mirror, compiled_.origin, out.mirrors);
    ++out.first_slab;
  }

  /// After all mirrors.
  void add_slab(const Slab& slab) {
    const double radius = length(Vec3d{slab.half[0], slab.half[1], slab.half[2]});
    add_flat(slab.middle, radius, slab.index, first_element_[slab.shape], 6);
    append_numbers(slab, compiled_.origin, out.slabs);
  }

  void add_pair(const SpecularPair& pair) {
    const std::size_t sphere = out.radius.size() - 1;
    const auto own = static_cast<std::int32_t>(out.sphere.size());
    if (pair.light < 0) {
      out.sun_pair_of.resize(sphere + 1, -1);
      out.sun_pair_of[sphere] = own;
    } else {
      out.pair_of[sphere * compiled_.lights.kind.size() + static_cast<std::size_t>(pair.light)] = own;
    }
    out.sphere.push_back(static_cast<std::int32_t>(sphere));
    out.light.push_back(pair.light);
    out.choice.kind.push_back(Lights::sphere);
    const auto k = static_cast<std::size_t>(pair.light);
    const bool by_flat = static_cast<int>(sphere) >= out.first_mirror;
    out.choice.power.push_back(by_flat ? compiled_.lights.power[k] : static_cast<float>(pair.worth));
    out.choice.reach2.push_back(by_flat ? compiled_.lights.reach2[k] : out.radius[sphere] * out.radius[sphere]);
    for (int i = 0; i < 3; ++i)
      out.choice.center[i].push_back(by_flat ? compiled_.lights.center[i][k]
                                             : out.center[i][sphere] + 0.5f * out.move[i][sphere]);
  }

  SpecularPairs finish() {
    if (!out.sun_pair_of.empty()) out.sun_pair_of.resize(out.radius.size(), -1);
    build_light_tree(out.choice);
    return std::move(out);
  }

  SpecularPairs out;

 private:
  void add_flat(Vec3d middle, double radius, double index, std::int32_t element, int faces) {
    const int sphere = static_cast<int>(out.radius.size());
    push(out.center, middle - compiled_.origin);
    push(out.move, {});
    out.radius.push_back(static_cast<float>(radius)), out.index.push_back(static_cast<float>(index));
    out.inner_radius.push_back(0), out.inner_index.push_back(1);
    out.outer.push_back(element), out.inner.push_back(element), out.overlapped.push_back(0);
    std::fill_n(out.sphere_of.begin() + element, faces, 2 * sphere);
    out.pair_of.resize(out.pair_of.size() + compiled_.lights.kind.size(), -1);
  }

  std::int32_t name(const Candidate& candidate, int sphere, int inner) {
    const std::int32_t element = first_element_[candidate.shape];
    out.sphere_of[static_cast<std::size_t>(element)] = 2 * sphere + inner;
    return element;
  }

  const Flattened& flat_;
  const RenderScene& compiled_;
  std::vector<std::int32_t> first_element_;  // of each shape
};

}  // namespace

SpecularPairs find_specular_pairs(const Flattened& flat, const Scene& scene, const RenderScene& compiled) {
  if (!needs_trait<&BsdfTraits::diffuse>(compiled.features) && !compiled.features.media) return {};
  const Found found = look_for_all(flat, scene);
  std::vector<SpecularPair> pairs = list_pairs(found, compiled);
  if (pairs.empty()) return {};
  weigh_by_visibility(flat, found, compiled, pairs);
  Filler filler(flat, compiled);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto sphere = static_cast<std::size_t>(pairs[i].sphere);
    const std::size_t first_mirror = found.spheres.size(), first_slab = first_mirror + found.mirrors.size();
    if (i == 0 || pairs[i].sphere != pairs[i - 1].sphere) {
      if (sphere < first_mirror)
        filler.add_sphere(found.spheres, found.spheres[sphere]);
      else if (sphere < first_slab)
        filler.add_mirror(found.mirrors[sphere - first_mirror]);
      else
        filler.add_slab(found.slabs[sphere - first_slab]);
    }
    filler.add_pair(pairs[i]);
  }
  return filler.finish();
}

}  // namespace tyndall

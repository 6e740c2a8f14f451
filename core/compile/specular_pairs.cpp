#include "core/compile/specular_pairs.h"

#include "core/compile/columns.h"
#include "core/compile/flat_objects.h"
#include "core/compile/overlap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace tyndall {
namespace {

constexpr double smallness = 0.25;  // most that a light's reach may be over its distance, or over the sphere around it
constexpr double smallness_for_glass = 0.15;  // the same for light through solid glass from outside
constexpr std::size_t max_pairs = 256;
constexpr std::size_t max_visibility_tests = 1 << 18;  // for more pairs times shapes all lights count as visible
constexpr double like_outside = 1e-3;  // an index counts as that of the outside if it is this close to 1

/// A sphere of glass or of metal without fuzz.
struct SmoothSphere {
  RoundBody body;
  double index;       // refractive index within over that outside; 0: metal
  std::size_t shape;  // index into Flattened::shapes
};

struct SphereOrShell {
  SmoothSphere outer;
  std::optional<SmoothSphere> inner;  // of a shell
};

using SpecularObject = std::variant<SphereOrShell, FlatMirror, Slab>;

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

std::vector<SmoothSphere> list_spheres(const Flattened& flat, const Scene& scene) {
  std::vector<SmoothSphere> list;
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

/// Joins spheres of glass around one centre to shells. Shells whose inside differs from their outside are left to BSDF
/// sampling: the deflection of a path through them may have more than one minimum or maximum, so that
/// specular_deflection.h would miss some paths.
std::vector<SphereOrShell> join_shells(const std::vector<SmoothSphere>& spheres) {
  std::vector<SphereOrShell> list;
  for (const SmoothSphere& own : spheres) {
    const SmoothSphere* inner = nullptr;
    bool is_inner = false;
    for (const SmoothSphere& other : spheres) {
      if (own.index == 0 || other.index == 0 || !concentric(own.body, other.body)) continue;
      const double radius = other.body.radius;
      is_inner = is_inner || radius > own.body.radius;
      if (radius < own.body.radius && (!inner || radius > inner->body.radius)) inner = &other;
    }
    if (is_inner || (inner && std::abs(own.index * inner->index - 1) > like_outside)) continue;
    list.push_back({own, inner ? std::optional(*inner) : std::nullopt});
  }
  return list;
}

struct SpecularPair {
  std::size_t object;
  int light;  // -1: the sun
  double worth;
};

/// Returns the worth of a pair of a sphere and a light, as for flat objects.
double worth_of(const SphereOrShell& object, const LightBounds& light) {
  const RoundBody& body = object.outer.body;
  const bool solid_glass = object.outer.index != 0 && !object.inner;
  const double reach = light.reach + 0.5 * length(body.motion);
  const double apart = length(light.center - (body.center + 0.5 * body.motion)),
               distance = std::max(apart, body.radius);
  const bool through_glass = solid_glass && apart > body.radius;
  if (reach > (through_glass ? smallness_for_glass : smallness) * distance) return 0;
  const double fraction = body.radius / distance;
  return light.power * fraction * fraction;
}

std::vector<SpecularPair> list_pairs(const Flattened& flat, const Scene& scene,
                                     const std::vector<SpecularObject>& objects, const RenderScene& compiled) {
  const SkyColumns& sky = compiled.sky;
  const bool has_sun = sky.is_sampled() && sky.distribution.sun.tangent != 0;
  const double sun = has_sun ? sky.distribution.sun.irradiance * static_cast<double>(sky.scale) : 0;  // irradiance
  std::vector<Receiver> receivers;  // listed only if there are mirrors
  std::vector<SpecularPair> pairs;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto* mirror = std::get_if<FlatMirror>(&objects[i]);
    if (mirror && receivers.empty()) receivers = list_receivers(flat, scene);
    for (int k = 0; k < compiled.lights.count(); ++k) {
      const LightBounds light = light_bounds(compiled, static_cast<std::size_t>(k));
      const double worth = std::visit([&](const auto& object) { return worth_of(object, light); }, objects[i]);
      if (worth > 0 && (!mirror || may_light(*mirror, light, receivers))) pairs.push_back({i, k, worth});
    }
    const auto* sphere = std::get_if<SphereOrShell>(&objects[i]);
    if (sphere && sun > 0) pairs.push_back({i, -1, sun * sphere->outer.body.radius * sphere->outer.body.radius});
  }
  if (pairs.size() > max_pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const SpecularPair& a, const SpecularPair& b) { return a.worth > b.worth; });
    pairs.resize(max_pairs);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const SpecularPair& a, const SpecularPair& b) { return a.object < b.object; });
  }
  return pairs;
}

/// Lowers the worth of pairs whose sphere does not see the whole light. The probability of a pair should be
/// proportional to the root of its light's mean square, and the remaining light reaches a fraction of the places only.
void weigh_by_visibility(const Flattened& flat, const std::vector<SpecularObject>& objects, const RenderScene& compiled,
                         std::vector<SpecularPair>& pairs) {
  if (pairs.size() * flat.shapes.size() > max_visibility_tests) return;
  const Obstacles obstacles = list_obstacles(flat);
  for (SpecularPair& pair : pairs) {
    const auto* sphere = std::get_if<SphereOrShell>(&objects[pair.object]);
    if (!sphere || pair.light < 0) continue;
    pair.worth *= std::sqrt(visible_fraction(obstacles, compiled.lights, static_cast<std::size_t>(pair.light),
                                             compiled.origin, sphere->outer.body));
  }
}

/// Fills the columns of SpecularPairs: first those of spheres and shells, then those of flat mirrors and of slabs.
struct Filler {
  const Flattened& flat;
  const RenderScene& compiled;
  std::vector<std::int32_t> first_element;  // of each shape
  SpecularPairs out;

  /// Appends the columns of a sphere, or of one around a flat object. element: the first of its `faces` elements.
  void append(const RoundBody& body, double index, std::int32_t element, int faces) {
    std::fill_n(out.sphere_of.begin() + element, faces, 2 * static_cast<int>(out.radius.size()));
    out.center.push_back(to_float(body.center - compiled.origin));
    out.move.push_back(to_float(body.motion));
    out.radius.push_back(static_cast<float>(body.radius)), out.index.push_back(static_cast<float>(index));
    out.inner_radius.push_back(0), out.inner_index.push_back(1);
    out.outer.push_back(element), out.inner.push_back(element), out.overlapped.push_back(0);
    out.sun_pair_of.push_back(-1);
    out.pair_of.resize(out.pair_of.size() + compiled.lights.kind.size(), -1);
  }

  void add(const SphereOrShell& object) {
    const auto& [outer, inner] = object;
    append(outer.body, outer.index, first_element[outer.shape], 1);
    if (inner) {
      const std::int32_t element = first_element[inner->shape];
      out.inner_radius.back() = static_cast<float>(inner->body.radius);
      out.inner_index.back() = static_cast<float>(outer.index * inner->index);
      out.inner.back() = element;
      out.sphere_of[element] = out.sphere_of[out.outer.back()] + 1;
    }
    const bool overlapped = is_overlapped(flat, outer.body, {outer.shape, inner ? inner->shape : outer.shape});
    out.overlapped.back() = overlapped ? 1 : 0;
    out.has_overlaps |= overlapped, out.shells |= inner.has_value();
    ++out.first_mirror, ++out.first_slab;
  }

  void add(const FlatMirror& mirror) {
    append({mirror.middle, {}, 0}, 0, first_element[mirror.shape] + mirror.face, 1);
    out.flats.push_back(record_of(mirror, compiled.origin));
    ++out.first_slab;
  }

  void add(const Slab& slab) {
    const double radius = length(Vec3d{slab.half[0], slab.half[1], slab.half[2]});
    append({slab.middle, {}, radius}, slab.index, first_element[slab.shape], 6);
    out.flats.push_back(record_of(slab, compiled.origin));
  }

  /// Appends a pair of the object that was added last.
  void add_pair(const SpecularPair& pair) {
    const std::size_t sphere = out.radius.size() - 1, k = static_cast<std::size_t>(pair.light);
    std::int32_t& own =
        pair.light < 0 ? out.sun_pair_of[sphere] : out.pair_of[sphere * compiled.lights.kind.size() + k];
    own = static_cast<std::int32_t>(out.sphere.size());
    out.sphere.push_back(static_cast<std::int32_t>(sphere));
    out.light.push_back(pair.light);
    out.choice.kind.push_back(Lights::sphere);
    const bool by_flat = static_cast<int>(sphere) >= out.first_mirror;
    out.choice.power.push_back(by_flat ? compiled.lights.power[k] : static_cast<float>(pair.worth));
    out.choice.reach2.push_back(by_flat ? compiled.lights.reach2[k] : out.radius[sphere] * out.radius[sphere]);
    out.choice.center.push_back(by_flat ? compiled.lights.center[k] : out.center[sphere] + 0.5f * out.move[sphere]);
  }
};

}  // namespace

SpecularPairs find_specular_pairs(const Flattened& flat, const Scene& scene, const RenderScene& compiled) {
  if (!needs_trait<&BsdfTraits::diffuse>(compiled.features) && !compiled.features.media) return {};
  const std::vector<Flat> flats = list_flats(flat);
  std::vector<SpecularObject> objects;
  const auto append = [&](const auto& list) { objects.insert(objects.end(), list.begin(), list.end()); };
  append(join_shells(list_spheres(flat, scene)));
  append(list_flat_mirrors(flat, flats, scene));
  append(list_slabs(flat, flats, scene));
  std::vector<SpecularPair> pairs = list_pairs(flat, scene, objects, compiled);
  if (pairs.empty()) return {};
  weigh_by_visibility(flat, objects, compiled, pairs);
  Filler filler{flat, compiled, first_elements(flat), {}};
  SpecularPairs& out = filler.out;
  out.sphere_of.assign(static_cast<std::size_t>(compiled.elements.count()), -1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || pairs[i].object != pairs[i - 1].object)
      std::visit([&](const auto& object) { filler.add(object); }, objects[pairs[i].object]);
    filler.add_pair(pairs[i]);
  }
  if (std::count(out.light.begin(), out.light.end(), -1) == 0) out.sun_pair_of = {};
  build_light_tree(out.choice);
  return std::move(out);
}

}  // namespace tyndall

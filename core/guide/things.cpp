#include "core/guide/things.h"

#include "core/trace/shade.h"

namespace tyndall {
namespace {

constexpr double max_fuzz = 0.3;  // of metal that counts as near-specular

bool is_near_specular(const SceneView& s, std::int32_t element) {
  const std::int32_t material = s.elements.material[element], kind = s.materials.kind[material];
  if (has_trait<&BsdfTraits::smooth_boundary>(s, kind)) return true;
  return has_trait<&BsdfTraits::glossy>(s, kind) && lobe_width_of(s, material) < max_fuzz;
}

/// The point of a flat where the first two rows of its map are a and b, and the third one is c.
Vec3d flat_point(const Affine& map, const double (&abc)[3]) {
  const Vec3d r[3] = {to_double(map.row[0]), to_double(map.row[1]), to_double(map.row[2])};
  const double scale = 1 / dot(r[0], cross(r[1], r[2]));
  Vec3d point{};
  for (int i = 0; i < 3; ++i)
    point = point + (scale * (abc[i] - static_cast<double>(map.offset[i]))) * cross(r[(i + 1) % 3], r[(i + 2) % 3]);
  return point;
}

/// A flat: an element, and its corner and edges. face: of a box; -1: a quad.
Thing flat_thing(const Affine& map, std::int32_t element, int face) {
  const auto corner = [&](double a, double b) {
    double abc[3] = {a, b, 0};
    if (face >= 0) abc[face / 2] = face % 2 == 0 ? -1 : 1, abc[(face / 2 + 1) % 3] = a, abc[(face / 2 + 2) % 3] = b;
    return flat_point(map, abc);
  };
  Thing thing;
  thing.element = element, thing.corner = corner(-1, -1);
  thing.u = corner(1, -1) - thing.corner, thing.v = corner(-1, 1) - thing.corner;
  return thing;
}

/// Sets what is not told by the shape.
void complete(const SceneView& s, Thing& thing) {
  const std::int32_t material = s.elements.material[thing.element];
  if (has_trait<&BsdfTraits::glossy>(s, s.materials.kind[material])) thing.fuzz = lobe_width_of(s, material);
  if (thing.fuzz <= static_cast<double>(min_sampled_fuzz)) thing.fuzz = 0;
  const Vec3d middle = thing.is_sphere ? thing.center : thing.corner + 0.5 * (thing.u + thing.v);
  const double area = thing.is_sphere ? pi * thing.radius * thing.radius : length(cross(thing.u, thing.v));
  for (int k = 0; k < std::min(s.lights.count(), max_guide_lights); ++k) {
    const Vec3d to_middle = middle - to_double(s.lights.center[k]);
    thing.power += at(s.lights.power, k) * std::min(area / std::max(dot(to_middle, to_middle), 1e-30), 4 * pi);
  }
  if (s.specular.pairs() == 0) return;
  const std::int32_t object = s.specular.sphere_of[thing.element] >> 1;
  if (object < 0) return;
  for (int k = 0; k < s.lights.count(); ++k)
    if (s.specular.pair_of[object * s.lights.count() + k] >= 0) thing.object = object;
}

void list_spheres(const SceneView& s, const Spheres& spheres, bool moving, std::vector<Thing>& things) {
  for (int i = 0; i < spheres.count(); ++i) {
    if (!is_near_specular(s, spheres.element[i])) continue;
    Thing thing;
    thing.element = spheres.element[i], thing.is_sphere = true, thing.radius = at(spheres.radius, i);
    thing.center = to_double(spheres.center[i]);
    if (moving) thing.motion = to_double(spheres.move[i]);
    things.push_back(thing);
  }
}

/// Whether some material of the scene has a trait.
template <auto trait>
bool has_any(const SceneView& s) {
  return needs_trait<trait>(s.features);
}

}  // namespace

std::vector<Thing> list_things(const SceneView& s) {
  std::vector<Thing> things;
  const bool some = has_any<&BsdfTraits::glossy>(s) || has_any<&BsdfTraits::smooth_boundary>(s);
  if (!some || s.lights.count() == 0 || !has_any<&BsdfTraits::diffuse>(s)) return things;
  list_spheres(s, s.spheres, false, things);
  list_spheres(s, s.moving_spheres, true, things);
  for (int i = 0; i < s.quads.count(); ++i)
    if (is_near_specular(s, s.quads.element[i])) things.push_back(flat_thing(s.quads.map[i], s.quads.element[i], -1));
  for (int i = 0; i < 6 * s.boxes.count(); ++i) {
    const std::int32_t element = s.boxes.element[i / 6] + i % 6;
    if (is_near_specular(s, element)) things.push_back(flat_thing(s.boxes.map[i / 6], element, i % 6));
  }
  for (Thing& thing : things) complete(s, thing);
  std::stable_sort(things.begin(), things.end(), [](const Thing& a, const Thing& b) {
    return a.power != b.power ? a.power > b.power : a.element < b.element;
  });
  if (things.size() > max_guided_things) things.resize(max_guided_things);
  return things;
}

}  // namespace tyndall

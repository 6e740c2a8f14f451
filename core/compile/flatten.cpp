#include "core/compile/flatten.h"

#include "core/base/elementary.h"
#include "core/base/kinds.h"
#include "core/base/math.h"
#include "core/scene/place.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

struct CosSin {
  double cos, sin;
};

/// Returns the cosine and sine of an angle, exactly for multiples of 90 degrees.
CosSin cos_sin(double degrees) {
  const double remainder = std::fmod(degrees, 360.0);
  if (std::fmod(remainder, 90.0) == 0) {
    const int quarter = (static_cast<int>(remainder / 90.0) + 4) % 4;
    constexpr double values[5] = {1, 0, -1, 0, 1};
    return {values[quarter], values[(quarter + 3) % 4]};
  }
  return {cosine(remainder * (pi / 180)), sine(remainder * (pi / 180))};
}

Placement placement_of(const RotateY& r) { return {r.degrees, {}}; }
Placement placement_of(const Translate& t) { return {0, t.offset}; }

void flatten_list(const std::vector<Object>& objects, const Placement& outer, std::int32_t group, Flattened& out) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Object& object = objects[i];
    const Placement here = compose(outer, placement_of(object.transform));
    const std::int32_t number = out.objects.add(group, i);
    std::visit(
        Overloaded{[&](const Solid3d& s) {
                     out.shapes.push_back({s.shape, here, s.material, number});
                   },
                   [&](const Volume& v) {
                     if (v.medium.density > 0)
                       out.volumes.push_back(
                           {v.boundary, compose(here, placement_of(v.boundary_transform)), v.medium, v.albedo, {}});
                   },
                   [&](const Group& g) { flatten_list(g.objects, here, number, out); }},
        object.kind);
  }
}

/// A hash of a shape and its placement: equal shapes have equal hashes.
std::uint64_t hash_of(const PlacedShape& placed) {
  std::uint64_t hash = placed.shape.index();
  const auto add_number = [&hash](double number) {  // -0 as +0; the multiplier is that of D. Knuth's MMIX generator
    hash = (hash ^ std::bit_cast<std::uint64_t>(number + 0.0)) * 6364136223846793005u;
    hash ^= hash >> 32;
  };
  const auto add_vector = [&](const Vec3d& v) { add_number(v.x), add_number(v.y), add_number(v.z); };
  const Overloaded add{add_number, add_vector, [&](const std::optional<Vec3d>& v) { add_vector(v.value_or(Vec3d{})); }};
  std::visit(
      [&]<class Shape>(const Shape& shape) {
        constexpr auto list = fields_of<Shape>();
        for_each_field(list, [&](const auto& field) { add(shape.*field.value); });
      },
      placed.shape);
  add(placed.placement.degrees);
  add(placed.placement.offset);
  return hash;
}

/// Drops exact copies of earlier shapes. Where surfaces coincide, rays hit the first; a ray that leaves it could
/// otherwise hit a copy, because its start is rounded.
void drop_copies(std::vector<PlacedShape>& shapes) {
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;
  keys.reserve(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) keys.push_back({hash_of(shapes[i]), i});
  std::sort(keys.begin(), keys.end());
  std::vector<bool> copy(shapes.size());
  for (std::size_t k = 1; k < keys.size(); ++k)
    for (std::size_t j = k; j-- > 0 && keys[j].first == keys[k].first;) {
      const PlacedShape &a = shapes[keys[j].second], &b = shapes[keys[k].second];
      if (!(a.shape == b.shape && a.placement == b.placement)) continue;
      copy[keys[k].second] = true;
      break;
    }
  std::erase_if(shapes, [&](const PlacedShape& one) { return copy[static_cast<std::size_t>(&one - shapes.data())]; });
}

bool same_shape(const PlacedShape& shape, const PlacedVolume& volume) {
  const auto is_same = [&](const auto& boundary) { return shape.shape == decltype(shape.shape)(boundary); };
  return shape.placement == volume.placement && std::visit(is_same, volume.boundary);
}

Vec3d own_center(const Sphere<>& s) { return s.center; }
Vec3d own_center(const Quad<>& q) { return q.corner + 0.5 * (q.u + q.v); }
Vec3d own_center(const Box<>& b) { return 0.5 * b.min + 0.5 * b.max; }
Vec3d own_center(const Triangle<>& t) { return t.corner + (1.0 / 3) * (t.u + t.v); }
Vec3d own_center(const Disk<>& d) { return d.center; }

Extent own_extent(const Sphere<>& s, const Camera& camera) {
  const Vec3d motion = s.center_end ? *s.center_end - s.center : Vec3d{};
  return {{s.center + camera.shutter_open * motion, s.center + camera.shutter_close * motion}, std::abs(s.radius)};
}
Extent own_extent(const Quad<>& q, const Camera&) {
  return {{q.corner, q.corner + q.u, q.corner + q.v, q.corner + q.u + q.v}};
}
Extent own_extent(const Box<>& b, const Camera&) {
  Extent extent;
  for (int i = 0; i < 8; ++i)
    extent.points.push_back({i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z});
  return extent;
}

Extent own_extent(const Triangle<>& t, const Camera&) { return {{t.corner, t.corner + t.u, t.corner + t.v}}; }
/// An octagon around the disk, whose sides touch the rim.
Extent own_extent(const Disk<>& d, const Camera&) {
  Extent extent;
  const double apothem = cosine(pi / 8);
  for (int i = 0; i < 8; ++i) {
    const double angle = (2 * i + 1) * pi / 8;
    extent.points.push_back(d.center + (1 / apothem) * (cosine(angle) * d.u + sine(angle) * d.v));
  }
  return extent;
}

Extent placed(Extent extent, const Placement& placement) {
  for (Vec3d& p : extent.points) p = place(placement, p);
  return extent;
}

/// Returns the name of a kind of material as a feature: its name in scene files, unless the kind defines another.
template <class Kind>
constexpr const char* feature_name() {
  if constexpr (requires { Kind::feature; })
    return Kind::feature;
  else
    return Kind::type;
}

}  // namespace

Vec3d rotate(const Placement& p, Vec3d v) {
  const CosSin a = cos_sin(p.degrees);
  return {a.cos * v.x + a.sin * v.z, v.y, a.cos * v.z - a.sin * v.x};
}

Vec3d place(const Placement& p, Vec3d v) { return rotate(p, v) + p.offset; }

Placement compose(const Placement& outer, const Placement& inner) {
  return {outer.degrees + inner.degrees, rotate(outer, inner.offset) + outer.offset};
}

Placement placement_of(const Transform& list) {
  Placement result;
  for (const auto& step : list)
    result = compose(std::visit([](const auto& move) { return placement_of(move); }, step), result);
  return result;
}

Flattened flatten(const Scene& scene) {
  Flattened out;
  out.shapes.reserve(scene.objects.size());  // enough where there are no groups
  out.objects.reserve(scene.objects.size());
  flatten_list(scene.objects, {}, -1, out);
  drop_copies(out.shapes);
  for (PlacedVolume& volume : out.volumes)
    for (std::size_t i = 0; i < out.shapes.size() && !volume.surface; ++i)
      if (same_shape(out.shapes[i], volume)) volume.surface = static_cast<int>(i);
  return out;
}

std::vector<std::int32_t> first_elements(const Flattened& flat) {
  std::vector<std::int32_t> first{0};
  for (const PlacedShape& shape : flat.shapes)
    first.push_back(first.back() + (std::holds_alternative<Box<>>(shape.shape) ? 6 : 1));
  return first;
}

Vec3d center_of(const PlacedShape& shape) {
  return place(shape.placement, std::visit([](const auto& s) { return own_center(s); }, shape.shape));
}
Vec3d center_of(const PlacedVolume& volume) {
  return place(volume.placement, std::visit([](const auto& s) { return own_center(s); }, volume.boundary));
}

Extent extent_of(const PlacedShape& shape, const Camera& camera) {
  return placed(std::visit([&](const auto& s) { return own_extent(s, camera); }, shape.shape), shape.placement);
}
Extent extent_of(const PlacedVolume& volume, const Camera& camera) {
  return placed(std::visit([&](const auto& s) { return own_extent(s, camera); }, volume.boundary), volume.placement);
}

SceneFeatures features_of(const Scene& scene, const Flattened& flat) {
  SceneFeatures n;
  std::vector<bool> used(scene.materials.size());
  std::vector<bool> textures(scene.textures.size());
  const auto use_colour = [&](const ColourOrTexture& c) {
    if (const auto* t = std::get_if<TextureIndex>(&c)) textures[static_cast<std::size_t>(t->index)] = true;
  };
  for (const PlacedShape& s : flat.shapes) {
    const auto* sphere = std::get_if<Sphere<>>(&s.shape);
    n.spheres |= sphere && !sphere->center_end;
    n.moving_spheres |= sphere && sphere->center_end;
    n.quads |= std::holds_alternative<Quad<>>(s.shape);
    n.boxes |= std::holds_alternative<Box<>>(s.shape);
    n.triangles |= std::holds_alternative<Triangle<>>(s.shape);
    n.disks |= std::holds_alternative<Disk<>>(s.shape);
    used[static_cast<std::size_t>(s.material)] = true;
  }
  for (const PlacedVolume& v : flat.volumes) {
    n.media = true;
    n.phase_functions |= v.medium.g != 0;
    use_colour(v.albedo);
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const Material& m = scene.materials[i];
    n.materials[m.kind.index()] = true;
    if (colour_name(m.kind)) use_colour(m.colour);
  }
  for (std::size_t i = 0; i < textures.size(); ++i) {
    n.textures |= textures[i];
    n.image_textures |= textures[i] && std::holds_alternative<Image>(scene.textures[i].kind);
  }
  n.background = !(scene.background == Background(Vec3d{0, 0, 0}));
  n.lens = scene.camera.defocus_angle > 0;
  n.shutter = n.moving_spheres && scene.camera.shutter_close > scene.camera.shutter_open;
  return n;
}

std::vector<std::string> names_of(const SceneFeatures& n) {
  std::vector<std::string> names;
  const auto add = [&names](const char* name, bool needed) {
    if (needed) names.emplace_back(name);
  };
  add("spheres", n.spheres), add("moving_spheres", n.moving_spheres), add("quads", n.quads), add("boxes", n.boxes);
  add("triangles", n.triangles), add("disks", n.disks);
  add("media", n.media), add("phase_functions", n.phase_functions);
  [&]<class... Kinds>(const std::variant<Kinds...>*) {
    (add(feature_name<Kinds>(), has_material<Kinds>(n)), ...);
  }(static_cast<const MaterialKinds<double>*>(nullptr));
  add("textures", n.textures), add("image_textures", n.image_textures);
  add("background", n.background), add("lens", n.lens), add("shutter", n.shutter);
  return names;
}

}  // namespace tyndall

#include "app/window/edit/object_list.h"

#include "app/window/edit/arrange.h"
#include "app/window/tools/camera_control.h"
#include "core/base/kinds.h"
#include "core/base/math.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace tyndall {
namespace {

bool starts_with(const ObjectPath& path, const ObjectPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

ObjectPaths with_linked_objects(const Scene& scene, const ObjectPaths& paths) {
  ObjectPaths all = paths;
  for (const ObjectPath& path : paths)
    for (const ObjectPath& other : linked_objects(scene, path)) all.push_back(other);
  return outermost(std::move(all));
}

/// Calls f with the index of each material that is used.
template <class F>
void each_material(std::vector<Object>& objects, const F& f) {
  each_object(objects, [&](Object& object) {
    if (Solid3d* solid = std::get_if<Solid3d>(&object.kind)) f(solid->material);
  });
}

void delete_unused_materials(Scene& scene, const std::vector<Material>& kept) {
  std::set<int> used;
  each_material(scene.objects, [&](int material) { used.insert(material); });
  for (int k = static_cast<int>(scene.materials.size()) - 1; k >= 0; --k) {
    const std::string& name = scene.materials[static_cast<std::size_t>(k)].name;
    const bool written = std::any_of(kept.begin(), kept.end(), [&](const Material& m) { return m.name == name; });
    if (used.contains(k) || written) continue;
    scene.materials.erase(scene.materials.begin() + k);
    each_material(scene.objects, [&](int& material) { material -= material > k ? 1 : 0; });
  }
}

constexpr double fraction_of_picture = 0.2;  // of a new object's size in the picture's height

/// The scene's material of that name and kind, else a new one with a name that is free.
int material_like(Scene& scene, const Material& wanted) {
  std::string name = wanted.name;
  for (int number = 2;; ++number) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const Material& material) { return material.name == name; });
    if (found == scene.materials.end()) break;
    if (found->kind == wanted.kind && (found->colour == wanted.colour || !colour_name(wanted.kind)))
      return static_cast<int>(found - scene.materials.begin());
    name = wanted.name + " " + std::to_string(number);
  }
  scene.materials.push_back(wanted);
  scene.materials.back().name = name;
  return static_cast<int>(scene.materials.size()) - 1;
}

ObjectPath append(Scene& scene, const char* name, std::variant<Solid3d, Volume, Group> kind) {
  scene.objects.push_back({free_name(scene, name), std::move(kind), {}});
  return {static_cast<int>(scene.objects.size()) - 1};
}

/// Shapes that stand on a spot, by numbers that print short.
struct Standing {
  const Spot& spot;
  double size = spot.size, half = 0.5 * size;
  DragRounding rounding{1, decimal_below(size).exponent - 2};

  Vec3d lifted(double by) const { return rounded(spot.point + by * spot.normal, rounding); }
  Sphere<> sphere(double radius) const { return {lifted(half), without_noise(radius), {}}; }
  Quad<> flat(double height) const {
    return {rounded(lifted(height) - Vec3d{half, 0, -half}, rounding), {size, 0, 0}, {0, 0, -size}};
  }
  Box<> box() const {
    const Vec3d low = rounded(lifted(half) - Vec3d{half, half, half}, rounding);
    return {low, without_noise(low + Vec3d{size, size, size})};
  }
  Triangle<> triangle() const {
    const Quad<> frame = flat(0.05 * size);
    return {frame.corner, frame.u, frame.v};
  }
};

ObjectPaths add_matt(Scene& scene, const char* name, const decltype(Solid3d::shape)& shape) {
  const int matt = material_like(scene, {"matt", Vec3d{0.7, 0.7, 0.7}, Lambertian<>{}});
  return {append(scene, name, Solid3d{shape, matt})};
}

ObjectPaths add_hollow_sphere(Scene& scene, const Spot& spot) {
  const Standing standing{spot};
  const int material = material_like(scene, {"glass", Material().colour, Dielectric<>{1.5}});
  const ObjectPath outer = append(scene, "shell", Solid3d{standing.sphere(standing.half), material});
  return {outer, append(scene, "shell inside", Solid3d{standing.sphere(-0.9 * standing.half), material})};
}

constexpr Addition all_additions[] = {
    {"a sphere", "add a ball, sphere, ball",
     [](Scene& scene, const Spot& spot) { return add_matt(scene, "ball", Standing{spot}.sphere(0.5 * spot.size)); }},
    {"a hollow ball", "hollow glass, bubble", add_hollow_sphere},
    {"a box", "cube, box, add a cube",
     [](Scene& scene, const Spot& spot) { return add_matt(scene, "box", Standing{spot}.box()); }},
    {"a quad", "plane, quad, add a plane",
     [](Scene& scene, const Spot& spot) { return add_matt(scene, "quad", Standing{spot}.flat(0.05 * spot.size)); }},
    {"a triangle", "triangle, polygon",
     [](Scene& scene, const Spot& spot) { return add_matt(scene, "triangle", Standing{spot}.triangle()); }},
    {"a disk", "disk, disc, circle, ring, ellipse, annulus",
     [](Scene& scene, const Spot& spot) {
       const double half = 0.5 * spot.size;
       return add_matt(scene, "disk", Disk<>{Standing{spot}.lifted(0.05 * spot.size), {half, 0, 0}, {0, 0, -half}, 0});
     }},
    {"a lamp", "light, lamp, add light, area light",
     [](Scene& scene, const Spot& spot) -> ObjectPaths {
       const int material = material_like(scene, {"lamp", Vec3d{8, 8, 8}, Light<>{}});
       return {append(scene, "lamp", Solid3d{Standing{spot}.flat(2 * spot.size), material})};
     }},
    {"fog", "volume, fog, smoke, mist, add a volume", [](Scene& scene, const Spot& spot) -> ObjectPaths {
       const Medium<> medium{nice_below(1 / spot.size).size(), 0};
       return {append(scene, "fog", Volume{Standing{spot}.sphere(spot.size), {}, medium, Vec3d{1, 1, 1}})};
     }}};

}  // namespace

std::vector<Object>& list_of(Scene& scene, const ObjectPath& path) {
  if (path.size() == 1) return scene.objects;
  Object& group = *find_object(scene, ObjectPath(path.begin(), path.end() - 1));
  return std::get<Group>(group.kind).objects;
}

ObjectPaths outermost(ObjectPaths paths) {
  std::sort(paths.begin(), paths.end());
  ObjectPaths result;
  for (const ObjectPath& path : paths)  // in this order a group stands before what is in it
    if (result.empty() || !starts_with(path, result.back())) result.push_back(path);
  return result;
}

std::string free_name(const Scene& scene, const std::string& wish) {
  std::set<std::string> names;
  each_object(scene.objects, [&](const Object& object) { names.insert(object.name); });
  if (!names.contains(wish)) return wish;
  std::string stem = wish;
  int number = 1;
  const std::size_t space = wish.find_last_of(' ');
  const std::string end = space == std::string::npos ? "" : wish.substr(space + 1);
  const bool numbered = !end.empty() && end.size() < 7 &&
                        std::all_of(end.begin(), end.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (numbered) stem = wish.substr(0, space), number = std::stoi(end);
  while (names.contains(stem + " " + std::to_string(++number))) {
  }
  return stem + " " + std::to_string(number);
}

ObjectPaths duplicate_objects(Scene& scene, const ObjectPaths& paths) {
  const ObjectPaths sources = with_linked_objects(scene, outermost(paths));
  ObjectPaths copies;
  for (std::size_t k = sources.size(); k-- > 0;) {  // from behind: the paths before stay as they are
    const ObjectPath& path = sources[k];
    Object copy = *find_object(scene, path);
    if (!copy.name.empty()) copy.name = free_name(scene, copy.name);
    std::vector<Object>& list = list_of(scene, path);
    list.insert(list.begin() + path.back() + 1, std::move(copy));
    for (ObjectPath& other : copies) {  // those behind it in the same list have moved by one
      const std::size_t level = path.size() - 1;
      if (other.size() > level && std::equal(path.begin(), path.end() - 1, other.begin()) && other[level] > path.back())
        ++other[level];
    }
    ObjectPath at = path;
    ++at.back();
    copies.push_back(std::move(at));
  }
  std::reverse(copies.begin(), copies.end());
  return copies;
}

int delete_objects(Scene& scene, const ObjectPaths& paths, const std::vector<Material>& kept) {
  const ObjectPaths all = with_linked_objects(scene, outermost(paths));
  for (std::size_t k = all.size(); k-- > 0;) {
    std::vector<Object>& list = list_of(scene, all[k]);
    list.erase(list.begin() + all[k].back());
  }
  delete_unused_materials(scene, kept);
  return static_cast<int>(all.size());
}

Vec3d normal_at(const Scene& scene, const ObjectPath& path, Vec3d point) {
  const Object* object = find_object(scene, path);
  const Solid3d* solid = object ? std::get_if<Solid3d>(&object->kind) : nullptr;
  if (!solid) return {0, 1, 0};
  const Placement placed = placement_at(scene, path);
  const Vec3d own = rotate({-placed.degrees, {}}, point - placed.offset);
  const Vec3d normal =
      std::visit(Overloaded{[&](const Sphere<>& sphere) { return own - sphere.center; },
                            [](const auto& flat) { return cross(flat.u, flat.v); },
                            [&](const Box<>& box) {
                              const double out[6] = {std::abs(own.x - box.min.x), std::abs(own.x - box.max.x),
                                                     std::abs(own.y - box.min.y), std::abs(own.y - box.max.y),
                                                     std::abs(own.z - box.min.z), std::abs(own.z - box.max.z)};
                              const auto face = std::min_element(out, out + 6) - out;
                              const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
                              return (face % 2 == 0 ? -1.0 : 1.0) * axes[face / 2];
                            }},
                 solid->shape);
  if (!(length(normal) > 0)) return {0, 1, 0};
  const Vec3d world = rotate(placed, normalize(normal));
  return dot(world, scene.camera.look_from - point) < 0 ? -1.0 * world : world;
}

Spot spot_at(const Scene& scene, ImagePoint at, const ObjectPath& object, Vec3d seen) {
  const Projection projection(scene);
  Spot spot;
  if (object.empty()) {
    const ViewRay view_ray = projection.view_ray(at);
    const double cosine = dot(view_ray.direction, axes_of(scene.camera).forward);
    spot.point = view_ray.origin + (target_distance(scene.camera) / cosine) * view_ray.direction;
  } else {
    spot.point = seen, spot.normal = normal_at(scene, object, seen);
  }
  const double depth = std::max(projection.depth_of(spot.point), 1e-6 * target_distance(scene.camera));
  spot.size = nice_below(fraction_of_picture * projection.height_at(depth)).size();
  return spot;
}

std::span<const Addition> additions() { return all_additions; }

const Addition& addition_named(std::string_view name) {
  return *std::find_if(std::begin(all_additions), std::end(all_additions),
                       [&](const Addition& one) { return one.name == name; });
}

}  // namespace tyndall

#include "app/window/edit/object_list.h"

#include "app/window/edit/arrange.h"
#include "app/window/edit/linked_objects.h"
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

void collect_names(const std::vector<Object>& objects, std::set<std::string>& names) {
  for (const Object& object : objects) {
    names.insert(object.name);
    if (const Group* group = std::get_if<Group>(&object.kind)) collect_names(group->objects, names);
  }
}

/// Calls f with the index of each material that is used.
template <class F>
void each_material(std::vector<Object>& objects, const F& f) {
  for (Object& object : objects) {
    if (Solid3d* solid = std::get_if<Solid3d>(&object.kind)) f(solid->material);
    if (Group* group = std::get_if<Group>(&object.kind)) each_material(group->objects, f);
  }
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

constexpr AdditionEntry entries[] = {{Addition::sphere, "sphere", "a matt ball"},
                                     {Addition::hollow_sphere, "hollow ball", "a thin shell of glass"},
                                     {Addition::box, "box", "a matt box"},
                                     {Addition::quad, "quad", "a matt square that lies flat"},
                                     {Addition::triangle, "triangle", "a matt triangle that lies flat"},
                                     {Addition::disk, "disk", "a matt disk that lies flat"},
                                     {Addition::light, "lamp", "a square that shines"},
                                     {Addition::medium, "fog", "a ball of mist"}};

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

int matt(Scene& scene) { return material_like(scene, {"matt", Vec3d{0.7, 0.7, 0.7}, Lambertian<>{}}); }
int glass(Scene& scene) { return material_like(scene, {"glass", Material().colour, Dielectric<>{1.5}}); }
int light_material(Scene& scene) { return material_like(scene, {"lamp", Vec3d{8, 8, 8}, Light<>{}}); }

ObjectPath append(Scene& scene, const char* name, std::variant<Solid3d, Volume, Group> kind) {
  scene.objects.push_back({free_name(scene, name), std::move(kind), {}});
  return {static_cast<int>(scene.objects.size()) - 1};
}

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
  collect_names(scene.objects, names);
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

std::span<const AdditionEntry> additions() { return entries; }

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

ObjectPaths add_object(Scene& scene, Addition what, const Spot& spot) {
  const double size = spot.size, half = 0.5 * size;
  const DragRounding drag_rounding{1, decimal_below(size).exponent - 2};
  const auto lifted = [&](double by) { return rounded(spot.point + by * spot.normal, drag_rounding); };
  const Vec3d on = lifted(half);
  const auto sphere = [&](double radius) { return Sphere<>{on, without_noise(radius), {}}; };
  const auto flat = [&](Vec3d middle) {
    return Quad<>{rounded(middle - Vec3d{half, 0, -half}, drag_rounding), {size, 0, 0}, {0, 0, -size}};
  };
  switch (what) {
    case Addition::sphere:
      return {append(scene, "ball", Solid3d{sphere(half), matt(scene)})};
    case Addition::hollow_sphere: {
      const int material = glass(scene);
      const ObjectPath outer = append(scene, "shell", Solid3d{sphere(half), material});
      return {outer, append(scene, "shell inside", Solid3d{sphere(-0.9 * half), material})};
    }
    case Addition::box: {
      const Vec3d low = rounded(on - Vec3d{half, half, half}, drag_rounding);
      return {append(scene, "box", Solid3d{Box<>{low, without_noise(low + Vec3d{size, size, size})}, matt(scene)})};
    }
    case Addition::quad:
      return {append(scene, "quad", Solid3d{flat(lifted(0.05 * size)), matt(scene)})};
    case Addition::triangle: {
      const Quad<> frame = flat(lifted(0.05 * size));
      return {append(scene, "triangle", Solid3d{Triangle<>{frame.corner, frame.u, frame.v}, matt(scene)})};
    }
    case Addition::disk: {
      const Disk<> disk{lifted(0.05 * size), {half, 0, 0}, {0, 0, -half}, 0};
      return {append(scene, "disk", Solid3d{disk, matt(scene)})};
    }
    case Addition::light:
      return {append(scene, "lamp", Solid3d{flat(lifted(2 * size)), light_material(scene)})};
    case Addition::medium:
      return {append(scene, "fog", Volume{sphere(size), {}, {nice_below(1 / size).size(), 0}, Vec3d{1, 1, 1}})};
  }
  return {};
}

}  // namespace tyndall

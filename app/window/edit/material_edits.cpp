#include "app/window/edit/material_edits.h"

#include "app/window/edit/arrange.h"
#include "core/base/kinds.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr const char* types[] = {Lambertian<>::type, Metal<>::type, Dielectric<>::type, Light<>::type, "fog within"};
constexpr int dielectric = 2, light = 3, medium_within = 4;  // places in `types`
constexpr double usual_power = 5;                            // of what becomes a light
constexpr Vec3d usual_albedo{0.8, 0.8, 0.8};

const Solid3d* solid_at(const Scene& scene, const ObjectPath& path) {
  const Object* object = find_object(scene, path);
  return object ? std::get_if<Solid3d>(&object->kind) : nullptr;
}

/// The medium that fills the object exactly; empty: there is none.
ObjectPath filling(const Scene& scene, const ObjectPath& path) {
  const Solid3d* solid = solid_at(scene, path);
  if (!solid) return {};
  for (const ObjectPath& other : linked_objects(scene, path)) {
    const Volume* volume = std::get_if<Volume>(&find_object(scene, other)->kind);
    if (volume && fills(*volume, *solid)) return other;
  }
  return {};
}

std::string free_material_name(const Scene& scene, const std::string& wish) {
  for (int number = 2;; ++number) {
    std::string name = wish + " " + std::to_string(number);
    const bool taken =
        std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return m.name == name; });
    if (!taken) return name;
  }
}

using KindsOfMaterial = MaterialMemory::mapped_type;

/// The last colour of a material that has none now: of when it was of the kind `type`, else of another one.
ColourOrTexture known_colour(const KindsOfMaterial& known, int type) {
  const auto& of_type = known[static_cast<std::size_t>(type)];
  if (of_type) return of_type->colour;
  if (type == light) return Vec3d{usual_power, usual_power, usual_power};
  for (const auto& other : known)
    if (other && colour_name(other->kind) && !std::holds_alternative<Light<>>(other->kind)) return other->colour;
  return usual_albedo;
}

/// The colour of a material that becomes one of the kind `type`. before: the kind it had.
ColourOrTexture colour_for(int type, const Material& before, const KindsOfMaterial& known) {
  const bool lit = std::holds_alternative<Light<>>(before.kind), lights = type == light;
  if (type == dielectric) return Material().colour;
  if (!colour_name(before.kind)) return known_colour(known, type);
  const Vec3d* colour = std::get_if<Vec3d>(&before.colour);
  if (!colour || lit == lights) return before.colour;
  const LightColour emission = light_colour(*colour);
  if (!lights) return without_noise(usual_albedo.x * emission.colour);
  const Vec3d* radiance = known[light] ? std::get_if<Vec3d>(&known[light]->colour) : nullptr;
  return light_radiance({emission.colour, radiance ? light_colour(*radiance).power : usual_power});
}

void set_kind(Material& material, int type, MaterialMemory& memory) {
  const Material before = material;
  if (static_cast<std::size_t>(type) == before.kind.index()) return;
  KindsOfMaterial& known = memory[material.name];
  known[before.kind.index()] = before;
  const decltype(material.kind) usual[] = {Lambertian<>{}, Metal<>{}, Dielectric<>{}, Light<>{}};
  const auto& same = known[static_cast<std::size_t>(type)];
  material.kind = same ? same->kind : usual[type];
  material.colour = colour_for(type, before, known);
}

/// Puts fog of that colour behind the object, with its very shape and place.
void fill(Scene& scene, const ObjectPath& path, const ColourOrTexture& colour) {
  const Object object = *find_object(scene, path);
  Volume volume;
  double size = 1;
  std::visit(Overloaded{[&](const Sphere<>& sphere) { volume.boundary = sphere, size = sphere.radius; },
                        [&](const Box<>& box) { volume.boundary = box, size = 0.5 * length(box.max - box.min); },
                        [](const auto&) {}},
             std::get<Solid3d>(object.kind).shape);
  volume.medium.density = nice_below(2 / size).size();
  if (const Vec3d* albedo = std::get_if<Vec3d>(&colour)) volume.albedo = *albedo;
  const std::string name = object.name.empty() ? "" : free_name(scene, object.name + " fog");
  std::vector<Object>& list = list_of(scene, path);
  list.insert(list.begin() + path.back() + 1, {name, volume, object.transform});
}

}  // namespace

std::span<const char* const> surface_types() { return types; }

int surface_type(const Scene& scene, const ObjectPath& path) {
  const Solid3d* solid = solid_at(scene, path);
  if (!solid) return -1;
  const Material& material = scene.materials[static_cast<std::size_t>(solid->material)];
  const bool glass = std::holds_alternative<Dielectric<>>(material.kind);
  return glass && !filling(scene, path).empty() ? medium_within : static_cast<int>(material.kind.index());
}

std::string why_not(const Scene& scene, const ObjectPath& path, int type) {
  const Solid3d* solid = solid_at(scene, path);
  if (!solid || type != medium_within) return solid ? "" : "it has no surface";
  const Sphere<>* sphere = std::get_if<Sphere<>>(&solid->shape);
  if (!sphere && !std::holds_alternative<Box<>>(solid->shape))
    return std::string("a ") + kind_name(*find_object(scene, path)) + " has no inside for fog";
  if (sphere && sphere->radius < 0) return "fog cannot be within a sphere of negative radius";
  if (sphere && sphere->center_end) return "fog cannot move with a moving sphere";
  return "";
}

ObjectPath set_surface_type(Scene& scene, const ObjectPath& path, int type, MaterialMemory& memory) {
  if (type == surface_type(scene, path) || !why_not(scene, path, type).empty()) return path;
  ObjectPath now = path;
  if (const ObjectPath medium = filling(scene, path); !medium.empty()) {
    std::vector<Object>& list = list_of(scene, medium);
    list.erase(list.begin() + medium.back());
    const std::size_t level = medium.size() - 1;  // what stood behind the fog in its list has moved
    const bool same_list = now.size() > level && std::equal(medium.begin(), medium.end() - 1, now.begin());
    if (same_list && now[level] > medium[level]) --now[level];
  }
  const auto material = [&]() -> Material& {
    return scene.materials[static_cast<std::size_t>(std::get<Solid3d>(find_object(scene, now)->kind).material)];
  };
  const bool glass = std::holds_alternative<Dielectric<>>(material().kind);
  if (type == medium_within && !glass) make_single_user(scene, now);
  const Material before = material();
  set_kind(material(), type == medium_within ? dielectric : type, memory);
  const auto* texture = std::get_if<TextureIndex>(&material().colour);
  if (texture && static_cast<std::size_t>(texture->index) >= scene.textures.size())
    material().colour = usual_albedo;  // it was remembered from before the file was read again
  if (type == medium_within) fill(scene, now, glass ? ColourOrTexture(Vec3d{1, 1, 1}) : before.colour);
  return now;
}

void make_single_user(Scene& scene, const ObjectPath& path) {
  Solid3d* solid = std::get_if<Solid3d>(&find_object(scene, path)->kind);
  if (!solid || users_of(scene, solid->material) < 2) return;
  Material copy = scene.materials[static_cast<std::size_t>(solid->material)];
  copy.name = free_material_name(scene, copy.name);
  scene.materials.push_back(std::move(copy));
  solid->material = static_cast<int>(scene.materials.size()) - 1;
}

LightColour light_colour(Vec3d radiance) {
  const double power = max_component(radiance);
  if (!(power > 0)) return {{1, 1, 1}, 0};
  const auto part = [&](double x) { return rounded(x / power, {1, -7}); };
  return {{part(radiance.x), part(radiance.y), part(radiance.z)}, power};
}

Vec3d light_radiance(LightColour emitted) {
  const double maximum = max_component(emitted.colour);
  if (!(maximum > 0)) return {emitted.power, emitted.power, emitted.power};
  const Vec3d radiance = (emitted.power / maximum) * emitted.colour;
  const DragRounding drag_rounding{1, decimal_below(std::max(emitted.power, 1e-30)).exponent - 5};
  return rounded(radiance, drag_rounding);
}

void set_background_kind(Background& background, int kind, BackgroundMemory& memory) {
  const Background before = background;
  if (kind == static_cast<int>(before.index())) return;
  memory[before.index()] = before;
  if (const auto& known = memory[static_cast<std::size_t>(kind)]) {
    background = *known;
    return;
  }
  const auto [up, down] =
      std::visit(Overloaded{[](const Vec3d& colour) { return std::pair(colour, colour); },
                            [](const Gradient& sky) { return std::pair(sky.top, sky.bottom); },
                            [](const Hemispheres& sky) { return std::pair(sky.up, sky.down); },
                            [](const SkyPicture&) { return std::pair(Gradient().top, Gradient().bottom); }},
                 before);
  if (kind == place_in<Vec3d, Background>) background = up;
  if (kind == place_in<Gradient, Background>) background = Gradient{down, up};
  if (kind == place_in<Hemispheres, Background>) background = Hemispheres{up, down};
}

}  // namespace tyndall

#include "core/scene/check.h"

#include "core/base/choice.h"
#include "core/base/kinds.h"
#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <unordered_set>

namespace tyndall {
namespace {

void check_value(const Place& at, const Meaning& meaning, double value) {
  const Valid& valid = meaning.valid;
  const bool good = std::isfinite(value) && valid.contains(value);
  // Kernels compute in single precision: there, too, the value must be finite and valid.
  const float single = static_cast<float>(value);
  if (good && std::isfinite(single) && valid.contains(static_cast<double>(single))) return;
  const std::string rounded = good ? " (" + number_text(static_cast<double>(single)) + " in single precision)" : "";
  fail(at, number_text(value) + rounded, expected_text(meaning, Form::number));
}
template <std::integral Whole>
void check_value(const Place& at, const Meaning& meaning, Whole value) {
  if (!meaning.valid.contains(value)) fail(at, std::to_string(value), expected_text(meaning, Form::whole));
}
void check_value(const Place&, const Meaning&, bool) {}
template <NamedEnum E>
void check_value(const Place& at, const Meaning&, E value) {
  if (!name_of(value)) fail(at, "choice number " + std::to_string(static_cast<int>(value)), one_of(names_of<E>()));
}
void check_value(const Place& at, const Meaning& meaning, const Vec3d& value) {
  const double components[3] = {value.x, value.y, value.z};
  for (std::size_t i = 0; i < 3; ++i) check_value({at, i}, meaning, components[i]);
}
template <class T>
void check_value(const Place& at, const Meaning& meaning, const std::optional<T>& value) {
  if (value) check_value(at, meaning, *value);
}

template <class Fields, class Owner>
void check_fields(const Place& at, const Fields& list, const Owner& owner) {
  for_each_field(list, [&](const auto& field) {
    check_value({at, field.name}, meaning_of(field), owner.*field.value);
  });
}
template <class Owner>
void check_fields(const Place& at, const Owner& owner) {
  check_fields(at, fields_of<Owner>(), owner);
}

/// The vector divided by its largest component, so that squares neither overflow nor vanish.
Vec3d scaled(Vec3d v) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return size > 0 ? Vec3d{v.x / size, v.y / size, v.z / size} : v;
}

/// True where a and b span no area, or next to none: the sine of their angle is at most 1e-6.
bool parallel(Vec3d a, Vec3d b) {
  a = scaled(a);
  b = scaled(b);
  const Vec3d across = cross(a, b);
  return dot(across, across) <= 1e-12 * dot(a, a) * dot(b, b);
}

void check_camera(const Place& at, const Camera& camera) {
  check_fields(at, camera);
  if (camera.look_from == camera.look_at)
    fail({at, "look_at"}, "the same point as look_from", "another point than look_from");
  if (parallel(camera.vup, camera.look_at - camera.look_from))
    fail({at, "vup"}, camera.vup == Vec3d{} ? "no direction" : "the direction of the view",
         "a direction that is not parallel to the view");
  const Place shutter{at, "shutter"};
  check_value({shutter, std::size_t{0}}, {any_number(), "", "time"}, camera.shutter_open);
  check_value({shutter, std::size_t{1}}, {any_number(), "", "time"}, camera.shutter_close);
  if (camera.shutter_open > camera.shutter_close)
    fail(shutter,
         "a shutter that closes (" + number_text(camera.shutter_close) + ") before it opens (" +
             number_text(camera.shutter_open) + ")",
         "two times, the first not after the second");
}

void check_background(const Place& at, const Background& background) {
  std::visit(Overloaded{[&](const Vec3d& radiance) { check_value(at, colour_meaning("radiance"), radiance); },
                        [&](const auto& sky) { check_fields(at, sky); }},
             background);
  const auto* sky = std::get_if<SkyPicture>(&background);
  if (sky && (!sky->pixels || sky->pixels->width < 1 || sky->pixels->height < 1))
    fail({at, "file"}, "no picture", "a picture of the sky of at least one pixel");
  if (sky && !std::isfinite(static_cast<float>(sky->scale * static_cast<double>(sky->pixels->largest))))
    fail({at, "scale"}, number_text(sky->scale),
         "a number that keeps the picture's largest, " + number_text(static_cast<double>(sky->pixels->largest)) +
             ", within single precision");
}

void check_colour(const Place& at, const Meaning& meaning, const ColourOrTexture& colour, const Scene& scene) {
  const auto* texture = std::get_if<TextureIndex>(&colour);
  if (!texture) return check_value(at, meaning, std::get<Vec3d>(colour));
  if (texture->index < 0 || static_cast<std::size_t>(texture->index) >= scene.textures.size())
    fail(at, "texture number " + std::to_string(texture->index), "a texture of the scene");
}

void check_texture(const Place& at, const Texture& texture) {
  std::visit(
      [&]<class T>(const T& kind) {
        if constexpr (!std::is_same_v<T, Image>) {
          check_fields(at, kind);
        } else if (!kind.pixels || kind.pixels->width < 1 || kind.pixels->height < 1) {
          fail({at, "file"}, "no picture", "an image of at least one pixel");
        }
      },
      texture.kind);
}

void check_material(const Place& at, const Material& material, const Scene& scene) {
  std::visit(
      [&]<class T>(const T& kind) {
        if constexpr (T::colour_name != nullptr)
          check_colour({at, T::colour_name}, colour_meaning(T::colour_name), material.colour, scene);
        check_fields(at, kind);
      },
      material.kind);
}

template <class T>
void check_names(const Place& at, const std::vector<T>& things) {
  std::unordered_set<std::string_view> names;
  for (const T& thing : things)
    if (!names.insert(thing.name).second) fail({at, thing.name}, "this name twice", "each name once");
}

template <class Shape>
void check_shape(const Place& at, const Shape& shape) {
  check_fields(at, shape);
  if constexpr (std::is_same_v<Shape, Box<>>) {
    const double low[3] = {shape.min.x, shape.min.y, shape.min.z}, high[3] = {shape.max.x, shape.max.y, shape.max.z};
    const Place max{at, "max"};
    for (std::size_t i = 0; i < 3; ++i)
      if (!(low[i] < high[i]))
        fail({max, i}, number_text(high[i]), "a number > " + number_text(low[i]) + " (min on this axis)");
  } else if constexpr (!std::is_same_v<Shape, Sphere<>>) {
    if (!parallel(shape.u, shape.v)) return;
    constexpr bool disk = std::is_same_v<Shape, Disk<>>;
    const std::string side = disk ? "a half axis" : "an edge", sides = disk ? "half axes" : "edges";
    const bool no_length = shape.u == Vec3d{} || shape.v == Vec3d{};
    fail(at, std::string("a ") + Shape::type + " with " + (no_length ? side + " of length 0" : "parallel " + sides),
         sides + " u and v that span an area");
  }
}

void check_transform(const Place& at, const Transform& transform) {
  const Place here{at, "transform"};
  for (std::size_t i = 0; i < transform.size(); ++i)
    std::visit([&](const auto& move) { check_fields({here, i}, move); }, transform[i]);
}

void check_volume(const Place& at, const Volume& volume, const Scene& scene) {
  const Place boundary{at, "boundary"};
  std::visit([&](const auto& shape) { check_shape(boundary, shape); }, volume.boundary);
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary)) {
    if (sphere->radius < 0)
      fail({boundary, "radius"}, number_text(sphere->radius), "a number > 0 (a boundary has no inward side)");
    if (sphere->center_end) fail({boundary, "center_end"}, "a boundary that moves", "a boundary at rest");
  }
  check_transform(boundary, volume.boundary_transform);
  check_fields(at, volume.medium);
  const Place albedo{at, "albedo"};
  check_colour(albedo, colour_meaning("albedo"), volume.albedo, scene);
  const auto* texture = std::get_if<TextureIndex>(&volume.albedo);
  if (texture && std::holds_alternative<Image>(scene.textures[static_cast<std::size_t>(texture->index)].kind))
    fail(albedo, "an image texture", "a colour or a texture without uv: a medium has no surface to lay an image on");
}

void check_objects(const Place& at, const std::vector<Object>& objects, const Scene& scene) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Place here{at, i};
    const Object& object = objects[i];
    std::visit(
        Overloaded{[&](const Solid3d& solid) {
                     std::visit([&](const auto& shape) { check_shape(here, shape); }, solid.shape);
                     if (solid.material < 0 || static_cast<std::size_t>(solid.material) >= scene.materials.size())
                       fail({here, "material"}, "material number " + std::to_string(solid.material),
                            "a material of the scene");
                   },
                   [&](const Volume& volume) { check_volume(here, volume, scene); },
                   [&](const Group& group) {
                     check_objects({here, "objects"}, group.objects, scene);
                   }},
        object.kind);
    check_transform(here, object.transform);
  }
}

void check_key(const Place& at, const KeyFrame& key, const KeyedValue& keyed, const Animation& animation) {
  const std::string frame = std::to_string(key.frame);
  const Place here{at, frame};
  if (key.frame < 0 || key.frame >= animation.frames)
    fail(here, "frame " + frame, "a frame from 0 to " + std::to_string(animation.frames - 1));
  if (key.value.empty() || key.value.size() != keyed.keys[0].value.size())
    fail(here, std::to_string(key.value.size()) + " values",
         "as many as at the first key, " + std::to_string(keyed.keys[0].value.size()));
  for (const double value : key.value)
    if (!std::isfinite(value)) fail(here, number_text(value), "a finite number");
}

/// Looks at the keys alone: whether each has its place in the scene is found by check_keys().
void check_animation(const Place& at, const Animation& animation) {
  check_fields(at, animation);
  const Place keys{at, "keys"};
  for (const KeyedValue& keyed : animation.keyed) {
    const Place here{keys, keyed.pointer};
    if (keyed.keys.empty()) fail(here, "no keys", "at least one, such as \"0\": 1");
    for (const KeyFrame& key : keyed.keys) check_key(here, key, keyed, animation);
  }
}

void check_all(const Scene& scene) {
  const Place at;
  check_fields({at, "image"}, image_fields(), scene);
  check_camera({at, "camera"}, scene.camera);
  check_background({at, "background"}, scene.background);
  check_fields({at, "render"}, scene.render);
  check_fields({at, "display"}, scene.display);
  if (scene.animation) check_animation({at, "animation"}, *scene.animation);
  const Place textures{at, "textures"}, materials{at, "materials"};
  check_names(textures, scene.textures);
  check_names(materials, scene.materials);
  for (const Texture& texture : scene.textures) check_texture({textures, texture.name}, texture);
  for (const Material& material : scene.materials) check_material({materials, material.name}, material, scene);
  check_objects({at, "objects"}, scene.objects, scene);
}

}  // namespace

std::optional<ParseError> check(const Scene& scene) {
  try {
    check_all(scene);
  } catch (ParseError& error) {
    return std::move(error);
  }
  return std::nullopt;
}

Scene checked(Scene scene) {
  if (const auto error = check(scene)) throw *error;
  return scene;
}

}  // namespace tyndall

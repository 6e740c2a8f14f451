#include "app/window/menus/row_list.h"

#include "app/window/panels/meaning.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace tyndall {
namespace {

/// Other words for rows, by the name of a field or row in the log. No word stands for two rows.
constexpr std::pair<std::string_view, const char*> row_words[] = {
    {"fuzz", "roughness, rough, glossiness, gloss"},
    {"refractive_index", "ior, index of refraction, refraction, eta"},
    {"albedo", "color, colour, base color, base colour, diffuse, tint, reflectance, texture"},
    {"radiance", "light texture, emission texture"},
    {"power", "emission, emissive, intensity, strength, luminance, lamp power, light power"},
    {"color", "light color, light colour, lamp color, lamp colour"},
    {"stops", "light stops"},
    {"scale", "texture scale, frequency, tiling"},
    {"even", "checker color, checkerboard"},
    {"odd", "second checker color"},
    {"style", "noise style, marble, turbulence"},
    {"file", "image texture, texture file, bitmap"},
    {"type", "material type, shader, bsdf, surface, metallic, metalness, transmission, glass"},
    {"material", "assign material, materials"},
    {"density", "fog density, extinction, opacity, absorption, thickness"},
    {"g", "g, anisotropy, anisotropic, phase function, henyey-greenstein, forward scattering"},
    {"center", "ball center, ball centre, object position"},
    {"center_end", "motion blur, movement"},
    {"radius", "diameter, ball size"},
    {"corner", "quad position"},
    {"u", "quad width"},
    {"v", "quad height"},
    {"inner", "inner radius, ring width"},
    {"min", "box size"},
    {"max", "upper corner"},
    {"rotate_y", "rotate, rotation, rotate y, yaw"},
    {"translate", "translation, offset, shift"},
    {"vfov", "fov, vfov, focal, focal length, lens, angle of view, zoom"},
    {"defocus_angle", "aperture, f-stop, f-number, depth of field, dof, bokeh, lens radius, defocus blur"},
    {"focus_distance", "focal distance, focus distance, focal plane, focus plane"},
    {"look_from", "camera position, eye, look from"},
    {"look_at", "look at, point of interest"},
    {"vup", "up vector, roll, tilt, vup"},
    {"exposure", "brightness, ev, gain"},
    {"tone_map", "tonemapping, tone mapping, tone curve, view transform, color management, filmic, aces, agx"},
    {"dither", "dithering, banding"},
    {"view", "aov, render pass, passes, channel"},
    {"max_depth", "bounces, max bounces, ray depth, max depth, path length, recursion"},
    {"spp", "samples, spp, samples per pixel, sample count, sampling, quality"},
    {"integrator", "render engine, method, next event estimation, light sampling"},
    {"sampler", "sobol, random numbers, quasi monte carlo"},
    {"fresnel", "schlick, reflectivity"},
    {"caustics", "manifold next event estimation, mnee"},
    {"sharing", "path reuse, reuse, restir"},
    {"seed", "random seed"},
    {"adaptive", "adaptive sampling"},
    {"size", "resolution, width, height, dimensions, film size"},
    {"at", "window size, preview size"},
    {"threads", "cpu, cores, processors"},
    {"kind", "background, sky, environment, environment light, world, hdri"},
    {"colour", "background color, background colour, sky color, sky colour"},
    {"bottom", "horizon"},
    {"top", "zenith"},
    {"up", "sky above"},
    {"down", "ground color, ground colour"},
    {"theme", "colour scheme, color scheme"},
    {"text", "text size, ui scale"},
};

const char* words_of(std::string_view name) {
  for (const auto& [of, words] : row_words)
    if (of == name) return words;
  return "";
}

template <class Owner>
std::vector<std::string_view> names() {
  return std::apply([](const auto&... field) { return std::vector<std::string_view>{field.name...}; },
                    fields_of<Owner>());
}

const Solid3d* solid_of(const Object& object) { return std::get_if<Solid3d>(&object.kind); }
const Volume* volume_of(const Object& object) { return std::get_if<Volume>(&object.kind); }

template <class Kind>
bool is_of(const Scene& scene, const Object& object) {
  const Material* material = material_of(scene, object);
  return material && std::holds_alternative<Kind>(material->kind);
}

/// The texture in the colour's place; null: it has none.
const Texture* texture_of(const Scene& scene, const Object& object) {
  const Material* material = material_of(scene, object);
  const bool coloured = material && colour_name(material->kind);
  const ColourOrTexture* colour = coloured            ? &material->colour
                                  : volume_of(object) ? &volume_of(object)->albedo
                                                      : nullptr;
  const TextureIndex* index = colour ? std::get_if<TextureIndex>(colour) : nullptr;
  return index ? &scene.textures[static_cast<std::size_t>(index->index)] : nullptr;
}
template <class Kind>
bool is_textured(const Scene& scene, const Object& object) {
  const Texture* texture = texture_of(scene, object);
  return texture && std::holds_alternative<Kind>(texture->kind);
}

template <class Shape>
bool has_shape(const Scene&, const Object& object) {
  return shape_of<Shape>(object) != nullptr;
}

template <class Step>
bool has_step(const Scene&, const Object& object) {
  const auto in = [](const Transform& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const auto& s) { return std::holds_alternative<Step>(s); });
  };
  return in(object.transform) || (volume_of(object) && in(volume_of(object)->boundary_transform));
}

bool is_solid(const Scene&, const Object& object) { return solid_of(object) != nullptr; }
bool is_volume(const Scene&, const Object& object) { return volume_of(object) != nullptr; }
bool is_matt_or_metal(const Scene& scene, const Object& object) {
  return is_of<Lambertian<>>(scene, object) || is_of<Metal<>>(scene, object);
}
bool is_plain_light(const Scene& scene, const Object& object) {
  return is_of<Light<>>(scene, object) && !texture_of(scene, object);
}
bool is_textured_light(const Scene& scene, const Object& object) {
  return is_of<Light<>>(scene, object) && texture_of(scene, object);
}
bool is_metal_sphere(const Scene& scene, const Object& object) {
  return is_of<Metal<>>(scene, object) && has_shape<Sphere<>>(scene, object);
}
bool moves(const Scene&, const Object& object) {
  const Sphere<>* sphere = shape_of<Sphere<>>(object);
  return sphere && sphere->center_end;
}

/// Rows that objects of some kind have.
struct ObjectRows {
  const char* who;  ///< "fog"
  std::vector<std::string_view> names;
  bool (*has)(const Scene&, const Object&);
  bool brief = false;  ///< also while nothing is selected
};

/// In the order in which the column shows them.
const std::vector<ObjectRows>& object_rows() {
  static const std::vector<ObjectRows> all = [] {
    std::vector<std::string_view> sphere = names<Sphere<>>();
    std::erase(sphere, "center_end");
    return std::vector<ObjectRows>{
        {"an object of metal", names<Metal<>>(), is_of<Metal<>>, true},
        {"an object of glass", names<Dielectric<>>(), is_of<Dielectric<>>, true},
        {"an object with a colour", {"albedo"}, is_matt_or_metal, true},
        {"a lamp with a texture", {"radiance"}, is_textured_light, true},
        {"a lamp", {"color", "power", "stops"}, is_plain_light, true},
        {"an object with a checker texture", names<Checker<>>(), is_textured<Checker<>>, true},
        {"an object with a noise texture", names<Noise<>>(), is_textured<Noise<>>, true},
        {"an object with a texture of one colour", names<Solid<>>(), is_textured<Solid<>>, true},
        {"an object with a picture as its texture", {"file"}, is_textured<Image>, true},
        {"an object with a surface", {"type", "material"}, is_solid},
        {"fog", names<Medium<>>(), is_volume, true},
        {"fog", {"albedo"}, is_volume},
        {"a sphere", sphere, has_shape<Sphere<>>},
        {"a sphere", {"radius"}, is_metal_sphere, true},
        {"a sphere that moves", {"center_end"}, moves},
        {"a quad", names<Quad<>>(), has_shape<Quad<>>},
        {"a triangle", names<Triangle<>>(), has_shape<Triangle<>>},
        {"a disk", names<Disk<>>(), has_shape<Disk<>>},
        {"a box", names<Box<>>(), has_shape<Box<>>},
        {"an object with a turn", names<RotateY>(), has_step<RotateY>},
        {"an object with a shift", names<Translate>(), has_step<Translate>},
    };
  }();
  return all;
}

using Names = std::vector<std::string_view>;

/// The label of a row by its name.
std::string label_of_row(std::string_view name) {
  static constexpr std::pair<std::string_view, const char*> others[] = {
      {"size", "Image size"}, {"at", "Render at"}, {"text", "Text size, %"}, {"file", "Picture"}};
  for (const auto& [of, label] : others)
    if (of == name) return label;
  return label_of(name);
}

void add(std::vector<RowEntry>& rows, const char* part, const Names& wanted, const std::string& missing = "") {
  for (const std::string_view name : wanted) rows.push_back({part, label_of_row(name), words_of(name), missing});
}

/// The rows of objects: one of each label, whoever has it.
void add_object_rows(std::vector<RowEntry>& rows) {
  for (const ObjectRows& some : object_rows())
    for (const std::string_view name : some.names) {
      const std::string label = label_of_row(name), who = some.who;
      const auto found =
          std::find_if(rows.begin(), rows.end(), [&](const RowEntry& row) { return row.label == label; });
      if (found == rows.end())
        rows.push_back({"Object", label, words_of(name), "select " + who});
      else if (found->missing.find(who) == std::string::npos)
        found->missing += " or " + who;
    }
  for (RowEntry& row : rows) row.missing += " first";
}

std::vector<RowEntry> all_rows() {
  std::vector<RowEntry> rows;
  add_object_rows(rows);
  add(rows, "Camera", {"vfov", "defocus_angle", "focus_distance", "look_from", "look_at", "vup"});
  add(rows, "Image", names<Display>());
  add(rows, "Image", {"view"});
  rows.push_back({"Histogram", "", "levels, clipping", ""});
  add(rows, "Render", names<RenderSettings>());
  add(rows, "Render", {"size", "at", "threads"});
  add(rows, "Background", {"kind"});
  const auto with_kind = [](const char* kind) {
    return std::string("choose ") + kind + " as the background's kind first";
  };
  add(rows, "Background", {"colour"}, with_kind("colour"));
  add(rows, "Background", names<Gradient>(), with_kind(Gradient::type));
  add(rows, "Background", names<Hemispheres>(), with_kind(Hemispheres::type));
  const std::string no_sky = "drop a picture of the sky on the window first";
  rows.push_back(
      {"Background", label_of_row("file"), "sky picture, hdr, environment map, environment texture", no_sky});
  rows.push_back({"Background", label_of_row("rotate_y"), "sky rotation, rotate sky, rotate environment", no_sky});
  rows.push_back({"Background", label_of_row("scale"), "sky strength, environment strength", no_sky});
  add(rows, "Window", {"theme", "text"});
  return rows;
}

bool has_row(const ObjectRows& rows, const std::string& label) {
  return std::any_of(rows.names.begin(), rows.names.end(), [&](auto name) { return label_of_row(name) == label; });
}

bool shows(const Background& background, const std::string& label) {
  const auto among = [&](const Names& all) {
    return std::any_of(all.begin(), all.end(), [&](auto name) { return label_of_row(name) == label; });
  };
  if (std::holds_alternative<Gradient>(background)) return among(names<Gradient>());
  if (std::holds_alternative<Hemispheres>(background)) return among(names<Hemispheres>());
  if (std::holds_alternative<SkyPicture>(background)) return among({"file", "rotate_y", "scale"});
  return among({"colour"});
}

}  // namespace

std::span<const RowEntry> row_entries() {
  static const std::vector<RowEntry> rows = all_rows();
  return rows;
}

std::string owner_of(const RowEntry& row, const Scene& scene, const ObjectPath& selected) {
  if (row.missing.empty()) return row.part;
  if (row.part == "Background") return shows(scene.background, row.label) ? row.part : "";
  const bool brief = !find_object(scene, selected);
  for (const ObjectPath& path : brief ? interesting(scene) : std::vector<ObjectPath>{selected})
    for (const ObjectRows& some : object_rows())
      if ((some.brief || !brief) && has_row(some, row.label) && some.has(scene, *find_object(scene, path)))
        return title_of(scene, path);
  return "";
}

}  // namespace tyndall

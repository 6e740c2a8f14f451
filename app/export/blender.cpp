#include "app/export/foreign_scene.h"
#include "app/text/markup.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"
#include "core/scene/place.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tyndall {

using Json = nlohmann::ordered_json;

static void to_json(Json& json, const Vec3d& v) { json = {v.x, v.y, v.z}; }

namespace blender {
namespace {

/// A texture, material or background as scene files have it: its type and its values.
template <class Kind>
Json values_of(const Kind& kind) {
  Json json{{"type", Kind::type}};
  if constexpr (!std::is_same_v<Kind, Image>)
    for_each_field(fields_of<Kind>(), [&](const auto& field) { json[field.name] = kind.*field.value; });
  return json;
}
Json values_of(const Vec3d& colour) { return {{"type", "constant"}, {"color", colour}}; }
template <class... Kinds>
Json values_of(const std::variant<Kinds...>& kinds) {
  return std::visit([](const auto& kind) { return values_of(kind); }, kinds);
}

/// Their sky mixes the first row with the last one, up to half of a row from the poles: rows so many that this is not
/// seen, of which every third, fifth, … lies where one of ours does.
LinearImage sky_copy(const Image::Pixels& sky) {
  int times = 1;
  while (times * sky.height < 512) times += 2;
  return sky_in_rows(sky, times * sky.height, [](int row, int rows) { return (row + 0.5) / rows; });
}

Json camera(const Camera& c) {
  const Vec3d forward = normalize(c.look_at - c.look_from), right = normalize(cross(forward, c.vup));
  return {{"at", c.look_from},
          {"forward", forward},
          {"up", cross(right, forward)},
          {"right", right},
          {"vfov", c.vfov},
          {"lens_radius", lens_radius(c)},
          {"focus", focus_of(c)},
          {"shutter", {c.shutter_open, c.shutter_close}}};
}

}  // namespace
}  // namespace blender

static void to_json(Json& json, const Material& m) {
  json = blender::values_of(m.kind);
  json["name"] = all_printable(m.name);
  if (const auto* colour = std::get_if<Vec3d>(&m.colour))
    json["colour"] = *colour;
  else
    json["texture"] = std::get<TextureIndex>(m.colour).index;
}
static void to_json(Json& json, const PlacedVolume& v) {
  json = {{"sigma_t", v.medium.density}, {"g", v.medium.g}, {"albedo", std::get<Vec3d>(v.albedo)}};
}
static Json shape_values(const ForeignShape& s, const Scene& scene) {
  Json json{{"material", s.material ? s.material - scene.materials.data() : -1}, {"medium", s.medium}};
  if (s.sphere) {
    json["center"] = s.sphere->center, json["center_end"] = s.sphere->center_end;
    json["radius"] = s.sphere->radius, json["inward"] = s.sphere->inward, json["degrees"] = s.sphere->degrees;
  }
  constexpr const char* keys[] = {"quads", "triangles", "disks"};
  for (const ForeignFlat& f : s.flats) json[keys[static_cast<int>(f.kind)]].push_back({f.origin, f.u, f.v, f.inner});
  return json;
}

ForeignFile blender_file(const Scene& scene, const std::string& name, const std::string& file) {
  using namespace blender;
  const ForeignRenderer cycles{"Blender's Cycles", true, true, true, true, true, false, true, true, true};
  const ForeignScene foreign = foreign_scene(scene, name, cycles);
  Json json{{"name", all_printable(scene.name.empty() ? name : scene.name)},
            {"width", scene.width},
            {"height", scene.height},
            {"max_depth", scene.render.max_depth},
            {"spp", scene.render.spp.value_or(64)},
            {"seed", scene.render.seed & 0x7fffffffu},
            {"camera", camera(scene.camera)},
            {"background", values_of(scene.background)},
            {"textures", Json::array()},
            {"materials", scene.materials},
            {"media", foreign.media},
            {"shapes", Json::array()}};
  for (const ForeignShape& s : foreign.shapes) json["shapes"].push_back(shape_values(s, scene));
  ForeignFile out;
  const auto write = [&](Json& user, const std::string& picture, LinearImage pixels) {
    user["file"] = picture;
    out.pictures.emplace_back(picture, std::move(pixels));
  };
  if (const auto* sky = std::get_if<SkyPicture>(&scene.background))
    write(json["background"], beside(file, ".py.sky.pfm"), sky_copy(*sky->pixels));
  for (const Texture& t : scene.textures) {
    const std::string picture = beside(file, fmt::format(".py.texture-{}.pfm", json["textures"].size()));
    json["textures"].push_back(values_of(t.kind));
    if (const auto* image = std::get_if<Image>(&t.kind))
      write(json["textures"].back(), picture, {image->pixels->width, image->pixels->height, image->pixels->rgb});
  }
  // The scene is one string of ASCII in the script, and JSON in that: nothing in it can become a statement.
  out.text = from_template("blender.py", {{"scene", Json(json.dump(-1, ' ', true)).dump(-1, ' ', true)}});
  return out;
}

}  // namespace tyndall

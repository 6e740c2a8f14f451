#include "app/export/foreign_scene.h"
#include "app/text/markup.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tyndall {
namespace blender {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3d v) { return {v.x, v.y, v.z}; }

/// picture: the name of the image's copy.
Json texture(const Texture& texture, const std::string& picture) {
  return std::visit(
      Overloaded{
          [](const Solid<>& s) {
            return Json{{"type", "solid"}, {"colour", json_of(s.color)}};
          },
          [](const Checker<>& c) {
            return Json{{"type", "checker"}, {"scale", c.scale}, {"even", json_of(c.even)}, {"odd", json_of(c.odd)}};
          },
          [&](const Image&) {
            return Json{{"type", "image"}, {"file", picture}};
          },
          [](const auto& other) {
            return Json{{"type", other.type}};
          }},
      texture.kind);
}

Json material(const Material& m) {
  Json json{{"name", all_printable(m.name)}, {"type", std::visit([](const auto& k) { return k.type; }, m.kind)}};
  if (const auto* glass = std::get_if<Dielectric<double>>(&m.kind)) json["index"] = glass->refractive_index;
  if (const auto* colour = std::get_if<Vec3d>(&m.colour))
    json["colour"] = json_of(*colour);
  else
    json["texture"] = std::get<TextureIndex>(m.colour).index;
  return json;
}

/// picture: the name of the copy of the sky's picture.
Json background(const Background& background, const std::string& picture) {
  return std::visit(
      Overloaded{[](const Vec3d& c) {
                   return Json{{"type", "constant"}, {"low", json_of(c)}, {"high", json_of(c)}};
                 },
                 [](const Gradient& g) {
                   return Json{{"type", "gradient"}, {"low", json_of(g.bottom)}, {"high", json_of(g.top)}};
                 },
                 [](const Hemispheres& h) {
                   return Json{{"type", "hemispheres"}, {"low", json_of(h.down)}, {"high", json_of(h.up)}};
                 },
                 [&](const SkyPicture& s) {
                   return Json{{"type", "image"}, {"file", picture}, {"degrees", s.rotate_y}, {"scale", s.scale}};
                 }},
      background);
}

/// Their sky mixes the first row with the last one, up to half of a row from the poles: rows so many that this is not
/// seen, of which every third, fifth, … lies where one of ours does.
LinearImage sky_copy(const Image::Pixels& sky) {
  int times = 1;
  while (times * sky.height < 512) times += 2;
  return sky_in_rows(sky, times * sky.height, [](int row, int rows) { return (row + 0.5) / rows; });
}

Json shape(const ForeignShape& s) {
  Json json{{"material", s.material}, {"medium", s.medium}};
  if (const auto* sphere = std::get_if<ForeignSphere>(&s.shape)) {
    json["center"] = json_of(sphere->center), json["center_end"] = json_of(sphere->center_end);
    json["radius"] = sphere->radius, json["inward"] = sphere->inward, json["degrees"] = sphere->degrees;
    return json;
  }
  std::visit(Overloaded{[](const ForeignSphere&) {},
                        [&](const std::vector<ForeignFlat>& flats) {
                          for (const ForeignFlat& f : flats)
                            json["flats"].push_back({json_of(f.corner), json_of(f.u), json_of(f.v)});
                        },
                        [&](const ForeignTriangle& t) {
                          json["triangle"] = {json_of(t.corner), json_of(t.u), json_of(t.v)};
                        },
                        [&](const ForeignDisk& d) {
                          json["disk"] = {json_of(d.center), json_of(d.u), json_of(d.v)}, json["inner"] = d.inner;
                        }},
             s.shape);
  return json;
}

Json camera(const Camera& c, const ForeignScene& foreign) {
  return {{"at", json_of(c.look_from)},
          {"forward", json_of(foreign.forward)},
          {"up", json_of(foreign.up)},
          {"right", json_of(foreign.right)},
          {"vfov", c.vfov},
          {"lens_radius", lens_radius(c)},
          {"focus", focus_of(c)},
          {"shutter", {c.shutter_open, c.shutter_close}}};
}

}  // namespace
}  // namespace blender

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
            {"camera", camera(scene.camera, foreign)},
            {"background", background(scene.background, beside(file, ".py.sky.pfm"))}};
  ForeignFile out;
  if (const auto* sky = std::get_if<SkyPicture>(&scene.background))
    out.pictures.emplace_back(beside(file, ".py.sky.pfm"), sky_copy(*sky->pixels));
  for (const char* list : {"textures", "materials", "media", "shapes"}) json[list] = Json::array();
  for (const Texture& t : scene.textures) {
    const std::string picture = beside(file, fmt::format(".py.texture-{}.pfm", json["textures"].size()));
    json["textures"].push_back(texture(t, picture));
    if (const auto* image = std::get_if<Image>(&t.kind))
      out.pictures.emplace_back(picture, LinearImage{image->pixels->width, image->pixels->height, image->pixels->rgb});
  }
  for (const Material& m : scene.materials) json["materials"].push_back(material(m));
  for (const ForeignMedium& m : foreign.media)
    json["media"].push_back({{"sigma_t", m.sigma_t}, {"g", m.g}, {"albedo", json_of(m.albedo)}});
  for (const ForeignShape& s : foreign.shapes) json["shapes"].push_back(shape(s));
  // The scene is one string of ASCII in the script, and JSON in that: nothing in it can become a statement.
  out.text = from_template("blender.py", {{"scene", Json(json.dump(-1, ' ', true)).dump(-1, ' ', true)}});
  return out;
}

}  // namespace tyndall

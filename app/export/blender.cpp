#include "app/export/blender_script.h"
#include "app/export/foreign_scene.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace tyndall {
namespace blender {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Vec3d v) { return {v.x, v.y, v.z}; }

Json texture(const Texture& texture) {
  return std::visit(
      Overloaded{
          [](const Solid<>& s) {
            return Json{{"type", "solid"}, {"colour", json_of(s.color)}};
          },
          [](const Checker<>& c) {
            return Json{{"type", "checker"}, {"scale", c.scale}, {"even", json_of(c.even)}, {"odd", json_of(c.odd)}};
          },
          [](const Image& i) {
            return Json{{"type", "image"}, {"file", all_printable(i.file)}};
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

Json background(const Background& background) {
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
                 [](const SkyPicture& s) {
                   return Json{
                       {"type", "image"}, {"file", all_printable(s.file)}, {"degrees", s.rotate_y}, {"scale", s.scale}};
                 }},
      background);
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

ForeignFile blender_file(const Scene& scene, const std::string& name) {
  using namespace blender;
  const ForeignRenderer cycles{"Blender's Cycles", true, true, true, true, true, false, true, true};
  const ForeignScene foreign = foreign_scene(scene, name, cycles);
  Json json{{"name", all_printable(scene.name.empty() ? name : scene.name)},
            {"width", scene.width},
            {"height", scene.height},
            {"max_depth", scene.render.max_depth},
            {"spp", scene.render.spp.value_or(64)},
            {"seed", scene.render.seed & 0x7fffffffu},
            {"camera", camera(scene.camera, foreign)},
            {"background", background(scene.background)}};
  for (const char* list : {"textures", "materials", "media", "shapes"}) json[list] = Json::array();
  for (const Texture& t : scene.textures) json["textures"].push_back(texture(t));
  for (const Material& m : scene.materials) json["materials"].push_back(material(m));
  for (const ForeignMedium& m : foreign.media)
    json["media"].push_back({{"sigma_t", m.sigma_t}, {"g", m.g}, {"albedo", json_of(m.albedo)}});
  for (const ForeignShape& s : foreign.shapes) json["shapes"].push_back(shape(s));
  // The scene is one string of ASCII in the script, and JSON in that: nothing in it can become a statement.
  const std::string data = Json(json.dump(-1, ' ', true)).dump(-1, ' ', true);
  return {
      std::string(blender_script_head) + "DATA = " + data + "\n" + std::string(blender_script), {}, {}, 0, 0, {}, {}};
}

}  // namespace tyndall

#include "app/export/foreign_scene.h"
#include "app/text/markup.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Scenes for Mitsuba 3 (W. Jakob et al., https://mitsuba.readthedocs.io), for its variants of RGB.
///
/// Its conventions: max_depth counts segments, one more than our events; a sphere's normal that points inward is
/// flip_normals; surfaces have one side unless they are "twosided"; lights shine on the side of their normal, so a
/// light becomes two shapes, a millionth of its size and distance from the origin apart; triangles are meshes in files
/// of their own; a surface without "bsdf" is grey, so lights get a black one.
namespace tyndall {
namespace mitsuba {
namespace {

std::string property(const char* type, const char* name, const std::string& value) {
  return fmt::format("<{} name=\"{}\" value=\"{}\"/>", type, name, value);
}
std::string number(const char* name, double value) { return property("float", name, number_text(value)); }
std::string whole(const char* name, int value) { return property("integer", name, std::to_string(value)); }
std::string rgb(const char* name, Vec3d c) { return property("rgb", name, numbers_of(c, ", ")); }
std::string point(const char* name, Vec3d p) {
  return fmt::format("<point name=\"{}\" x=\"{}\" y=\"{}\" z=\"{}\"/>", name, number_text(p.x), number_text(p.y),
                     number_text(p.z));
}

/// Where their rows lie, of 1: the first one straight above, the last one straight below.
double place_of_row(int row, int rows) { return static_cast<double>(row) / (rows - 1); }

std::string background(const Scene& scene, const std::string& file, ForeignFile& out) {
  if (const auto* colour = std::get_if<Vec3d>(&scene.background))
    return *colour == Vec3d{} ? "" : "  <emitter type=\"constant\">" + rgb("radiance", *colour) + "</emitter>\n";
  const auto* sky = std::get_if<SkyPicture>(&scene.background);
  const std::string name = beside(file, ".xml.sky.pfm");
  // Every second of their rows, from the second one on, lies where one of ours does.
  constexpr int rows = 2049;  // of a sky that depends on the height alone
  const auto colour = [&](int, int y) {
    return colour_at(scene.background, std::cos(place_of_row(y, rows) * std::numbers::pi));
  };
  out.pictures.emplace_back(
      name, sky ? sky_in_rows(*sky->pixels, 2 * sky->pixels->height + 1, place_of_row) : picture_of(4, rows, colour));
  return fmt::format(
      "  <emitter type=\"envmap\"><string name=\"filename\" value=\"{}\"/>{}<transform name=\"to_world\"><rotate "
      "y=\"1\" angle=\"{}\"/></transform></emitter>\n",
      in_xml(name), number("scale", sky ? sky->scale : 1),
      number_text(180 + (sky ? sky->rotate_y : 0)));  // their pictures begin half a turn before ours
}

std::string medium(const ForeignScene& foreign, int index, const char* name) {
  const ForeignMedium& m = foreign.media[static_cast<std::size_t>(index)];
  return fmt::format("<medium name=\"{}\" type=\"homogeneous\">{}{}<phase type=\"hg\">{}</phase></medium>", name,
                     rgb("albedo", m.albedo), number("sigma_t", m.sigma_t), number("g", m.g));
}

std::string camera(const Scene& scene, const ForeignScene& foreign) {
  const Camera& c = scene.camera;
  const bool thin = c.defocus_angle > 0;
  std::string text = fmt::format(
      "  <sensor type=\"{}\">\n    <transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" "
      "up=\"{}\"/></transform>\n"
      "    <string name=\"fov_axis\" value=\"y\"/>{}{}{}\n",
      thin ? "thinlens" : "perspective", numbers_of(c.look_from, ", "), numbers_of(c.look_at, ", "),
      numbers_of(c.vup, ", "), number("fov", c.vfov), number("near_clip", 1e-4 * focus_of(c)),
      number("far_clip", 1e8 * focus_of(c)));
  if (thin) text += "    " + number("aperture_radius", lens_radius(c)) + number("focus_distance", focus_of(c)) + "\n";
  if (foreign.camera_medium >= 0) text += "    " + medium(foreign, foreign.camera_medium, "medium") + "\n";
  text += fmt::format(
      "    <film type=\"hdrfilm\">{}{}<rfilter type=\"box\"/><string name=\"pixel_format\" value=\"rgb\"/><string "
      "name=\"component_format\" value=\"float32\"/></film>\n",
      whole("width", scene.width), whole("height", scene.height));
  return text + fmt::format("    <sampler type=\"independent\">{}{}</sampler>\n  </sensor>\n",
                            whole("sample_count", scene.render.spp.value_or(64)),
                            whole("seed", static_cast<int>(scene.render.seed & 0x7fffffffu)));
}

std::string diffuse(Vec3d colour) {
  return "<bsdf type=\"twosided\"><bsdf type=\"diffuse\">" + rgb("reflectance", colour) + "</bsdf></bsdf>";
}

Vec3d colour_of(const Material& material, const Scene& scene) {
  return plain_colour(material, scene).value_or(Vec3d{});
}

std::string surface(const Material& material, const Scene& scene) {
  return std::visit(
      Overloaded{
          [&](const Dielectric<double>& glass) {
            return "<bsdf type=\"dielectric\">" + number("int_ior", glass.refractive_index) + number("ext_ior", 1) +
                   "</bsdf>";
          },
          [&](const Metal<double>&) {
            return "<bsdf type=\"twosided\"><bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>" +
                   rgb("specular_reflectance", colour_of(material, scene)) + "</bsdf></bsdf>";
          },
          [&](const Light<double>&) {
            return "<emitter type=\"area\">" + rgb("radiance", colour_of(material, scene)) + "</emitter>" + diffuse({});
          },
          [&](const auto&) { return diffuse(colour_of(material, scene)); }},
      material.kind);
}

std::string sphere(const ForeignSphere& s, const std::string& inner) {
  return "  <shape type=\"sphere\">" + point("center", s.center) + number("radius", s.radius) +
         (s.inward ? "<boolean name=\"flip_normals\" value=\"true\"/>" : "") + inner + "</shape>\n";
}

/// Half of the distance between the two sides of a light: more than single precision loses there.
double half_gap(double size, Vec3d middle) { return 1e-6 * (size + length(middle)); }

/// A light that shines on both sides: two spheres of one side each.
std::string sphere_light(ForeignSphere s, const std::string& inner) {
  ForeignSphere inside = s;
  const double half = half_gap(s.radius, s.center);
  s.radius += half, s.inward = false;
  inside.radius -= std::min(half, 0.5 * inside.radius), inside.inward = true;
  return sphere(s, inner) + sphere(inside, inner);
}

constexpr const char* triangle_file = "unit-triangle.ply";
constexpr const char* triangle_mesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A flat shape of theirs, in the plane of x and y with the normal z, that is placed in the world.
struct Flat {
  std::string type;  ///< with what it needs of its own
  Vec3d x, y, origin;
};

/// Their rectangle is [-1, 1]² in x and y. out: gets the triangle's mesh.
Flat flat_of(const ForeignFlat& f, ForeignFile& out) {
  using enum ForeignFlat::Kind;
  if (f.kind == quad) return {"rectangle\">", 0.5 * f.u, 0.5 * f.v, f.origin + 0.5 * (f.u + f.v)};
  if (f.kind == disk) return {"disk\">", f.u, f.v, f.origin};
  out.meshes[triangle_file] = triangle_mesh;
  return {std::string("ply\"><string name=\"filename\" value=\"") + triangle_file + "\"/>", f.u, f.v, f.origin};
}

std::string placed(const Flat& f, const std::string& inner) {
  std::string matrix;
  for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z})
    for (const Vec3d& column : {f.x, f.y, normalize(cross(f.x, f.y)), f.origin})
      matrix += number_text(column.*axis) + " ";
  return "  <shape type=\"" + f.type + "<transform name=\"to_world\"><matrix value=\"" + matrix +
         "0 0 0 1\"/></transform>" + inner + "</shape>\n";
}

/// A flat light, which shines on both sides: two of one side each. All these shapes are the same with x and y swapped,
/// which turns the normal.
std::string flat_light(Flat f, const std::string& inner) {
  const Vec3d apart = half_gap(std::max(length(f.x), length(f.y)), f.origin) * normalize(cross(f.x, f.y));
  const Flat other{f.type, f.y, f.x, f.origin - apart};
  f.origin = f.origin + apart;
  return placed(f, inner) + placed(other, inner);
}

std::string shape(const ForeignShape& s, const Scene& scene, const ForeignScene& foreign, ForeignFile& out) {
  const Material* material = s.material < 0 ? nullptr : &scene.materials[static_cast<std::size_t>(s.material)];
  const std::string inner = (material ? surface(*material, scene) : "<bsdf type=\"null\"/>") +
                            (s.medium < 0 ? "" : medium(foreign, s.medium, "interior"));
  const bool light = material && std::holds_alternative<Light<double>>(material->kind);
  if (s.sphere) return light ? sphere_light(*s.sphere, inner) : sphere(*s.sphere, inner);
  std::string text;
  for (const ForeignFlat& flat : s.flats)
    text += light ? flat_light(flat_of(flat, out), inner) : placed(flat_of(flat, out), inner);
  return text;
}

}  // namespace
}  // namespace mitsuba

ForeignFile mitsuba_file(const Scene& scene, const std::string& name, const std::string& file) {
  using namespace mitsuba;
  const ForeignRenderer renderer{"Mitsuba 3", true, false, false, false, false, true, false, false, false};
  const ForeignScene foreign = foreign_scene(scene, name, renderer);
  ForeignFile out;
  out.text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- by tyndall convert, for Mitsuba 3 -->\n<scene "
      "version=\"3.0.0\">\n";
  out.text += fmt::format("  <integrator type=\"{}\">{}{}</integrator>\n", foreign.media.empty() ? "path" : "volpath",
                          whole("max_depth", scene.render.max_depth + 1), whole("rr_depth", 16));
  out.text += camera(scene, foreign) + background(scene, file, out);
  for (const ForeignShape& s : foreign.shapes) out.text += shape(s, scene, foreign, out);
  out.text += "</scene>\n";
  return out;
}

}  // namespace tyndall

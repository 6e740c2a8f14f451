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
  const PlacedVolume& volume = foreign.media[static_cast<std::size_t>(index)];
  return fmt::format("<medium name=\"{}\" type=\"homogeneous\">{}{}<phase type=\"hg\">{}</phase></medium>", name,
                     rgb("albedo", std::get<Vec3d>(volume.albedo)), number("sigma_t", volume.medium.density),
                     number("g", volume.medium.g));
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

std::string surface(const ForeignShape& s, const Scene& scene) {
  if (!s.material) return "<bsdf type=\"null\"/>";
  if (const auto* glass = std::get_if<Dielectric<double>>(&s.material->kind))
    return "<bsdf type=\"dielectric\">" + number("int_ior", glass->refractive_index) + number("ext_ior", 1) + "</bsdf>";
  const Vec3d colour = plain_colour(*s.material, scene).value_or(Vec3d{});
  if (s.shines()) return "<emitter type=\"area\">" + rgb("radiance", colour) + "</emitter>" + diffuse({});
  if (!std::holds_alternative<Metal<double>>(s.material->kind)) return diffuse(colour);
  return "<bsdf type=\"twosided\"><bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>" +
         rgb("specular_reflectance", colour) + "</bsdf></bsdf>";
}

/// Half of the distance between the two sides of a light: more than single precision loses there.
double half_gap(double size, Vec3d middle) { return 1e-6 * (size + length(middle)); }

/// A light shines on both sides: two spheres of one side each.
std::string sphere(const ForeignSphere& s, bool light, const std::string& inner) {
  const auto one = [&](double radius, bool inward) {
    return fmt::format("  <shape type=\"sphere\"><point name=\"center\" x=\"{}\" y=\"{}\" z=\"{}\"/>{}{}{}</shape>\n",
                       number_text(s.center.x), number_text(s.center.y), number_text(s.center.z),
                       number("radius", radius), inward ? "<boolean name=\"flip_normals\" value=\"true\"/>" : "",
                       inner);
  };
  if (!light) return one(s.radius, s.inward);
  const double half = half_gap(s.radius, s.center);
  return one(s.radius + half, false) + one(s.radius - std::min(half, 0.5 * s.radius), true);
}

constexpr const char* triangle_file = "unit-triangle.ply";
constexpr const char* triangle_mesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Their flat shapes lie in the plane of x and y with the normal z, and are placed in the world; the rectangle is
/// [-1, 1]² in x and y. A light shines on both sides: two of one side each. All these shapes are the same with x and y
/// swapped, which turns the normal.
std::string flat(const ForeignFlat& f, bool light, const std::string& inner) {
  const bool quad = f.kind == ForeignFlat::Kind::quad, disk = f.kind == ForeignFlat::Kind::disk;
  const std::string type = quad   ? "rectangle\">"
                           : disk ? "disk\">"
                                  : fmt::format("ply\"><string name=\"filename\" value=\"{}\"/>", triangle_file);
  const auto one = [&](Vec3d x, Vec3d y, Vec3d origin) {
    std::string matrix;
    for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z})
      for (const Vec3d& column : {x, y, normalize(cross(x, y)), origin}) matrix += number_text(column.*axis) + " ";
    return "  <shape type=\"" + type + "<transform name=\"to_world\"><matrix value=\"" + matrix +
           "0 0 0 1\"/></transform>" + inner + "</shape>\n";
  };
  const double half = quad ? 0.5 : 1;
  const Vec3d x = half * f.u, y = half * f.v, middle = quad ? f.origin + 0.5 * (f.u + f.v) : f.origin;
  if (!light) return one(x, y, middle);
  const Vec3d apart = half_gap(std::max(length(x), length(y)), middle) * normalize(cross(x, y));
  return one(x, y, middle + apart) + one(y, x, middle - apart);
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
  for (const ForeignShape& s : foreign.shapes) {
    const std::string inner = surface(s, scene) + (s.medium < 0 ? "" : medium(foreign, s.medium, "interior"));
    if (s.sphere) out.text += sphere(*s.sphere, s.shines(), inner);
    for (const ForeignFlat& f : s.flats) {
      out.text += flat(f, s.shines(), inner);
      if (f.kind == ForeignFlat::Kind::triangle) out.meshes[triangle_file] = triangle_mesh;
    }
  }
  out.text += "</scene>\n";
  return out;
}

}  // namespace tyndall

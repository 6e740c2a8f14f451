#include "app/export/foreign_scene.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"
#include "core/trace/sky.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <set>

/// Scenes for pbrt-v4 (M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th edition; its file format:
/// https://pbrt.org/fileformat-v4).
///
/// Its conventions: the camera is left-handed, so x is mirrored before LookAt; fov is that of the shorter side; a
/// normal that points inward is ReverseOrientation; depth counts scattering events as ours does; RGB of lights and
/// surfaces are linear Rec.709; WorldBegin leaves the camera's MediumInterface as it is; images and checkers are
/// blurred unless that is switched off; the film's sensor multiplies by exposure time times ISO / 100, which is made 1.
namespace tyndall {
namespace pbrt {
namespace {

/// A string of the file: in quotes, with what would end it escaped.
std::string in_pbrt(const std::string& text) { return in_quotes(all_printable(text)); }

std::string rgb(const char* name, Vec3d colour) { return fmt::format("\"rgb {}\" [ {} ]", name, numbers_of(colour)); }
std::string number(const char* name, double value) { return fmt::format("\"float {}\" {}", name, number_text(value)); }

std::string medium_name(int medium) { return medium < 0 ? "\"\"" : fmt::format("\"medium {}\"", medium); }

/// The direction of a point of the square [0, 1]², which is covered evenly; z is up. P. Clarberg, Fast Equal-Area
/// Mapping of the (Hemi)Sphere using SIMD, Journal of Graphics Tools 13 (2008).
Vec3d direction_of(double x, double y) {
  const double u = 2 * x - 1, v = 2 * y - 1, rest = 1 - std::abs(u) - std::abs(v), r = 1 - std::abs(rest);
  const double phi = (r == 0 ? 1 : (std::abs(v) - std::abs(u)) / r + 1) * std::numbers::pi / 4;
  const double out = r * std::sqrt(2 - r * r);
  return {std::copysign(std::cos(phi), u) * out, std::copysign(std::sin(phi), v) * out, std::copysign(1 - r * r, rest)};
}

/// A sky in the layout that pbrt reads: a square. One of a picture has about as many pixels, each a mean over some of
/// its area, so that a sun of one texel keeps its light.
LinearImage square_sky(const Background& background) {
  const auto* picture = std::get_if<SkyPicture>(&background);
  int edge = 512;
  if (!picture)
    return picture_of(edge, edge, [&](int x, int y) {
      return colour_at(background, direction_of((x + 0.5) / edge, (y + 0.5) / edge).y);
    });
  const SkyColumns sky = sky_columns(*picture, false, nullptr);
  constexpr int parts = 4;
  while (edge < picture->pixels->width && edge < 4096) edge *= 2;
  return picture_of(edge, edge, [&](int x, int y) {
    Vec3d sum;
    for (int k = 0; k < parts * parts; ++k) {
      const int across = k % parts, down = k / parts;
      const double column = x + (across + 0.5) / parts, row = y + (down + 0.5) / parts;
      sum = sum + sky_towards<double>(sky, direction_of(column / edge, row / edge)).radiance;
    }
    return 1.0 / (parts * parts) * sum;
  });
}

std::string background(const Scene& scene, const std::string& file, ForeignFile& out) {
  if (const auto* colour = std::get_if<Vec3d>(&scene.background))
    return *colour == Vec3d{} ? "" : "LightSource \"infinite\" " + rgb("L", *colour) + "\n";
  const std::string name = beside(file, ".pbrt.sky.pfm");
  out.pictures.emplace_back(name, square_sky(scene.background));
  return "LightSource \"infinite\" \"string filename\" " + in_pbrt(name) + "\n";
}

std::string camera(const Scene& scene, const ForeignScene& foreign, const std::string& file) {
  const Camera& c = scene.camera;
  const double aspect = static_cast<double>(scene.width) / scene.height,
               half = std::tan(c.vfov * std::numbers::pi / 360);
  const double fov = aspect >= 1 ? c.vfov : 360 / std::numbers::pi * std::atan(half * aspect);
  const bool opens = c.shutter_close > c.shutter_open;
  const double open = opens ? c.shutter_open : 0, close = opens ? c.shutter_close : 1;
  std::string text = fmt::format("Scale -1 1 1\nLookAt {}\n       {}\n       {}\n", numbers_of(c.look_from),
                                 numbers_of(c.look_at), numbers_of(c.vup));
  if (foreign.camera_medium >= 0) text += "MediumInterface \"\" " + medium_name(foreign.camera_medium) + "\n";
  text += "Camera \"perspective\" " + number("fov", fov);
  if (c.defocus_angle > 0)
    text += " " + number("lensradius", lens_radius(c)) + " " + number("focaldistance", focus_of(c));
  text += " " + number("shutteropen", open) + " " + number("shutterclose", close) + "\n";
  text += fmt::format("Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {} \"string filename\" {} {}\n",
                      scene.width, scene.height, in_pbrt(beside(file, ".exr")), number("iso", 100 / (close - open)));
  text += "PixelFilter \"box\" \"float xradius\" 0.5 \"float yradius\" 0.5\n";
  text += fmt::format("Sampler \"independent\" \"integer pixelsamples\" {} \"integer seed\" {}\n",
                      scene.render.spp.value_or(64), scene.render.seed);
  return text + fmt::format("Integrator \"volpath\" \"integer maxdepth\" {}\n", scene.render.max_depth);
}

std::string texture_name(std::size_t index, bool round) {
  return fmt::format("\"texture {}{}\"", index, round ? " round" : "");
}

/// Their images wrap in both directions or in none. round: for spheres, around which only u goes on: with the last
/// column before the first, and the first behind the last.
std::string image(const Image& image, std::size_t index, bool round, const std::string& file, ForeignFile& out) {
  const std::string name = beside(file, fmt::format(".pbrt.texture-{}{}.pfm", index, round ? "-round" : ""));
  const Image::Pixels& pixels = *image.pixels;
  const int width = pixels.width, more = round ? 1 : 0;
  out.pictures.emplace_back(name, picture_of(width + 2 * more, pixels.height, [&](int x, int y) {
                              return texel(pixels, (x - more + width) % width, y);
                            }));
  const double columns = width + 2;
  return "\"imagemap\" \"string filter\" \"bilinear\" \"string wrap\" \"clamp\" \"string filename\" " + in_pbrt(name) +
         (round ? " " + number("uscale", width / columns) + " " + number("udelta", 1 / columns) : "");
}

/// The textures that shapes have.
std::string textures(const Scene& scene, const ForeignScene& foreign, const std::string& file, ForeignFile& out) {
  std::set<std::pair<std::size_t, bool>> used;
  for (const ForeignShape& shape : foreign.shapes)
    if (const auto* texture = shape.material ? std::get_if<TextureIndex>(&shape.material->colour) : nullptr)
      used.emplace(static_cast<std::size_t>(texture->index), shape.sphere.has_value());
  std::string text;
  for (const auto& [index, round] : used) {
    const std::string begin = "Texture " + texture_name(index, round) + " \"spectrum\" ";
    if (const auto* own = std::get_if<Image>(&scene.textures[index].kind))
      text += begin + image(*own, index, round, file, out) + "\n";
    if (const auto* checker = std::get_if<Checker<>>(&scene.textures[index].kind))
      text +=
          fmt::format("AttributeBegin\n  Scale {0} {0} {0}\n  {1}\"checkerboard\" \"integer dimension\" 3 {2} {3}\n",
                      number_text(checker->scale), begin, rgb("tex1", checker->even), rgb("tex2", checker->odd)) +
          "AttributeEnd\n";
  }
  return text;
}

/// The material of a surface, and its light.
std::string surface(const ForeignShape& s, const Scene& scene) {
  if (!s.material) return "  Material \"interface\"\n";
  if (const auto* glass = std::get_if<Dielectric<double>>(&s.material->kind))
    return "  Material \"dielectric\" " + number("eta", glass->refractive_index) + "\n";
  const auto colour = plain_colour(*s.material, scene);
  const std::string begin = "  Material \"diffuse\" ";
  if (s.shines())
    return begin + rgb("reflectance", {}) + "\n  AreaLightSource \"diffuse\" " + rgb("L", colour.value()) +
           " \"bool twosided\" true\n";
  if (colour) return begin + rgb("reflectance", *colour) + "\n";
  const auto texture = static_cast<std::size_t>(std::get<TextureIndex>(s.material->colour).index);
  return begin + "\"texture reflectance\" " + texture_name(texture, s.sphere.has_value()) + "\n";
}

std::string shape(const ForeignSphere& s) {
  std::string text;
  if (s.moves())
    text = fmt::format(
        "  ActiveTransform StartTime\n  Translate {}\n  ActiveTransform EndTime\n  Translate {}\n  ActiveTransform "
        "All\n",
        numbers_of(s.center), numbers_of(s.center_end));
  else
    text = "  Translate " + numbers_of(s.center) + "\n";
  if (s.degrees != 0) text += "  Rotate " + number_text(s.degrees) + " 0 1 0\n";
  text +=
      "  ConcatTransform [ -1 0 0 0  0 0 1 0  0 1 0 0  0 0 0 1 ]\n";  // their z is our y; u of images begins at our -x
  if (s.inward) text += "  ReverseOrientation\n";
  return text + "  Shape \"sphere\" " + number("radius", s.radius) + "\n";
}

/// Their disk lies in the plane of x and y; its normal is z. The transform only turns and shifts it: under one that
/// scales, lights would have the wrong area.
std::string disk(const ForeignFlat& d) {
  const double radius = length(d.u);
  const Vec3d x = normalize(d.u), z = normalize(cross(d.u, d.v)), y = cross(z, x);
  return fmt::format("  ConcatTransform [ {} 0  {} 0  {} 0  {} 1 ]\n  Shape \"disk\" {} {}\n", numbers_of(x),
                     numbers_of(y), numbers_of(z), numbers_of(d.origin), number("radius", radius),
                     number("innerradius", d.inner * radius));
}

std::string shape(const ForeignFlat& f) {
  if (f.kind == ForeignFlat::Kind::disk) return disk(f);
  const bool quad = f.kind == ForeignFlat::Kind::quad;
  return fmt::format(
      "  Shape \"trianglemesh\" \"integer indices\" [ {} ] \"point3 P\" [ {}  {}{}  {} ]\n    \"point2 uv\" [ {} ]\n",
      quad ? "0 1 2 0 2 3" : "0 1 2", numbers_of(f.origin), numbers_of(f.origin + f.u),
      quad ? "  " + numbers_of(f.origin + f.u + f.v) : "", numbers_of(f.origin + f.v),
      quad ? "0 0 1 0 1 1 0 1" : "0 0 1 0 0 1");
}

std::string medium(const PlacedVolume& volume, std::size_t index) {
  const auto [extinction, g] = volume.medium;
  const Vec3d scattering = extinction * std::get<Vec3d>(volume.albedo),
              absorption = Vec3d{extinction, extinction, extinction} - scattering;
  return fmt::format("MakeNamedMedium \"medium {}\" \"string type\" \"homogeneous\" {} {} {}\n", index,
                     rgb("sigma_a", absorption), rgb("sigma_s", scattering), number("g", g));
}

}  // namespace
}  // namespace pbrt

ForeignFile pbrt_file(const Scene& scene, const std::string& name, const std::string& file) {
  using namespace pbrt;
  const ForeignRenderer renderer{"pbrt-v4", false, true, true, true, false, true, false, true, true};
  const ForeignScene foreign = foreign_scene(scene, name, renderer);
  ForeignFile out;
  out.text = "# " + all_printable(scene.name.empty() ? name : scene.name) + ", by tyndall convert, for pbrt-v4\n";
  out.text += "Option \"disabletexturefiltering\" true\n";
  for (std::size_t i = 0; i < foreign.media.size(); ++i) out.text += medium(foreign.media[i], i);
  out.text += camera(scene, foreign, file) + "TransformTimes 0 1\nWorldBegin\n";
  if (foreign.camera_medium >= 0) out.text += "MediumInterface \"\" \"\"\n";
  out.text += background(scene, file, out) + textures(scene, foreign, file, out);
  for (const ForeignShape& s : foreign.shapes) {
    out.text += "AttributeBegin\n" + surface(s, scene);
    if (s.medium >= 0) out.text += "  MediumInterface " + medium_name(s.medium) + " \"\"\n";
    if (s.sphere) out.text += shape(*s.sphere);
    for (const ForeignFlat& flat : s.flats) out.text += shape(flat);
    out.text += "AttributeEnd\n";
  }
  return out;
}

}  // namespace tyndall

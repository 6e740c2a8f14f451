#include "core/compile/columns.h"

#include "core/base/kinds.h"
#include "core/base/math.h"
#include "core/base/random.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr double radians = pi / 180;

/// Without a lens the focus distance has no effect, and must not change how other numbers are rounded.
double focus_distance(const Camera& camera) {
  if (camera.defocus_angle == 0) return length(camera.look_from - camera.look_at);
  return camera.focus_distance.value_or(length(camera.look_from - camera.look_at));
}

Vec3d modulo(Vec3d v, double period) {
  return {std::fmod(v.x, period), std::fmod(v.y, period), std::fmod(v.z, period)};
}

void fill(TextureColumns& out, const Solid<>& solid, Vec3d) { out.a = to_float(solid.color); }

void fill(TextureColumns& out, const Checker<>& checker, Vec3d origin) {
  out.a = to_float(checker.even);
  out.b = to_float(checker.odd);
  out.scale = static_cast<float>(1 / checker.scale);
  out.offset = to_float(modulo((1 / checker.scale) * origin, 2));
}

void fill(TextureColumns& out, const Noise<>& noise, Vec3d origin) {
  // The scale of marble is that of its veins; the turbulence that bends them is not scaled.
  const double scale = noise.style == Noise<>::Style::marble ? 1 : noise.scale;
  out.style = noise.style;
  out.scale = static_cast<float>(scale);
  out.offset = to_float(modulo(scale * origin, 256));
  out.z_scale = static_cast<float>(noise.scale / (2 * pi));
  out.z_offset = static_cast<float>(std::fmod(noise.scale * origin.z / (2 * pi), 1.0));
}

void fill(TextureColumns& out, const Image& image, Vec3d) {
  out.width = image.pixels->width;
  out.height = image.pixels->height;
  out.pixels = image.pixels;
}

}  // namespace

void push(std::vector<float> (&columns)[3], Vec3d v) {
  columns[0].push_back(static_cast<float>(v.x));
  columns[1].push_back(static_cast<float>(v.y));
  columns[2].push_back(static_cast<float>(v.z));
}

double lens_radius(const Camera& camera) {
  return focus_distance(camera) * std::tan(0.5 * camera.defocus_angle * radians);
}

CameraColumns camera_columns(const Camera& camera, int width, int height, Vec3d origin) {
  const Vec3d w = normalize(camera.look_from - camera.look_at);
  const Vec3d u = normalize(cross(camera.vup, w)), v = cross(w, u);
  const double focus = focus_distance(camera);
  const double view_height = 2 * std::tan(0.5 * camera.vfov * radians) * focus;
  const double view_width = view_height * width / height;
  const double lens = lens_radius(camera);
  CameraColumns out;
  out.center = to_float(camera.look_from - origin);
  out.corner = to_float((-focus) * w - (0.5 * view_width) * u + (0.5 * view_height) * v);
  out.du = to_float((view_width / width) * u);
  out.dv = to_float((-view_height / height) * v);
  out.lens_u = to_float(lens * u);
  out.lens_v = to_float(lens * v);
  out.axis = to_float(-w);
  out.shutter_open = static_cast<float>(camera.shutter_open);
  out.shutter_length = static_cast<float>(camera.shutter_close - camera.shutter_open);
  return out;
}

BackgroundColumns background_columns(const Background& background) {
  using Columns = BackgroundColumns;
  return std::visit(Overloaded{[](const Vec3d& colour) {
                                 return Columns{BackgroundKind::constant, to_float(colour), {}};
                               },
                               [](const Gradient& g) {
                                 return Columns{BackgroundKind::gradient, to_float(g.bottom), to_float(g.top)};
                               },
                               [](const Hemispheres& h) {
                                 return Columns{BackgroundKind::hemispheres, to_float(h.up), to_float(h.down)};
                               }},
                    background);
}

Materials material_columns(const std::vector<Material>& materials) {
  Materials out;
  for (const Material& material : materials) {
    out.kind.push_back(static_cast<std::int32_t>(material.kind.index()));
    const auto* texture = std::get_if<TextureIndex>(&material.colour);
    const bool coloured = colour_name(material.kind) != nullptr;
    const Vec3f colour = coloured && !texture ? to_float(std::get<Vec3d>(material.colour)) : Vec3f{1, 1, 1};
    out.red.push_back(colour.x);
    out.green.push_back(colour.y);
    out.blue.push_back(colour.z);
    out.texture.push_back(coloured && texture ? texture->index : -1);
    for (auto& column : out.parameter) column.push_back(0);
    std::visit(
        [&](const auto& m) {
          std::size_t i = 0;
          std::apply([&](const auto&... f) { ((out.parameter[i++].back() = static_cast<float>(m.*f.value)), ...); },
                     fields(&m));
        },
        material.kind);
  }
  return out;
}

std::vector<TextureColumns> texture_columns(const std::vector<Texture>& textures, Vec3d origin) {
  std::vector<TextureColumns> out;
  for (const Texture& texture : textures) {
    TextureColumns columns;
    columns.kind = static_cast<std::int32_t>(texture.kind.index());
    std::visit([&](const auto& t) { fill(columns, t, origin); }, texture.kind);
    out.push_back(std::move(columns));
  }
  return out;
}

std::shared_ptr<const std::vector<float>> gradient_table() {
  auto table = std::make_shared<std::vector<float>>();
  for (std::uint32_t i = 0; i < 256; ++i) {
    const double z = 1 - 2 * unit_interval<double>(hash(2 * i + 1)),
                 phi = 2 * pi * unit_interval<double>(hash(2 * i + 2));
    const double r = std::sqrt(1 - z * z);
    for (const double c : {r * std::cos(phi), r * std::sin(phi), z}) table->push_back(static_cast<float>(c));
  }
  return table;
}

}  // namespace tyndall

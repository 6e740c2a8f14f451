#include "core/compile/columns.h"

#include "core/base/elementary.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/shapes/outline.h"

#include <algorithm>
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
  out.texels = image.pixels->rgb.data();
}

BackgroundColumns columns_of(const Vec3d& colour) { return {BackgroundKind::constant, to_float(colour), {}}; }
BackgroundColumns columns_of(const Gradient& g) {
  return {BackgroundKind::gradient, to_float(g.bottom), to_float(g.top)};
}
BackgroundColumns columns_of(const Hemispheres& h) {
  return {BackgroundKind::hemispheres, to_float(h.up), to_float(h.down)};
}
BackgroundColumns columns_of(const SkyPicture&) { return {BackgroundKind::picture, {}, {}}; }

void set_row(Affine& map, int i, Vec3d row, Vec3d zero_at) {
  map.row[i] = to_float(row);
  map.offset[i] = static_cast<float>(-dot(row, zero_at));
}

/// Appends the elements of one shape to the columns.
struct Appender {
  const PlacedShape& shape;
  Vec3d origin;
  const SceneFeatures& features;
  const Checker<>* checker;
  Elements& to;

  void append(Vec3f center_or_normal, float inverse_radius, Vec3f move, double plane) const {
    to.center_or_normal.push_back(center_or_normal), to.inverse_radius.push_back(inverse_radius);
    if (features.moving_spheres) to.move.push_back(move);
    if (features.textures) to.plane.push_back(static_cast<float>(plane));
    if (features.image_textures && features.disks)
      to.disk.push_back(std::holds_alternative<Disk<>>(shape.shape) ? 1 : 0);
    to.material.push_back(shape.material);
    to.object.push_back(shape.object);
  }

  /// See Elements::plane. normal: unit; point: on the flat, in the world.
  double plane_of(Vec3d normal, Vec3d point) const {
    constexpr double near = 1e-3;  // of a cell
    const double own = dot(normal, point - origin);
    for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      if (!checker || std::abs(normal.*axis) < 1 - 1e-12) continue;
      const double cells = point.*axis / checker->scale, border = std::round(cells);
      if (std::abs(cells - border) >= near) return own;
      const double within = std::floor(cells) < border ? border - near : border + near;
      return own + normal.*axis * (within - cells) * checker->scale;
    }
    return own;
  }

  void append_flat(const BoxFace& face) const {
    append(to_float(face.normal), 0, {}, features.textures ? plane_of(face.normal, face.corner) : 0);
    if (!features.image_textures) return;
    const Reciprocal r = reciprocal_edges(face.u, face.v);
    for (const Vec3d row : {r.a, r.b})
      for (const double c : {row.x, row.y, row.z, -dot(row, face.corner - origin)})
        to.uv.push_back(static_cast<float>(c));
  }

  void append_sphere(const Sphere<>& s) const {
    const Placement& at = shape.placement;
    const Vec3d motion = s.center_end ? *s.center_end - s.center : Vec3d{};
    append(to_float(place(at, s.center) - origin), static_cast<float>(1 / s.radius), to_float(rotate(at, motion)), 0);
    if (!features.image_textures) return;
    const Vec3d x_axis = rotate(at, {1, 0, 0});  // (cos, 0, -sin)
    for (const double c : {x_axis.x, -x_axis.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}) to.uv.push_back(static_cast<float>(c));
  }
};

}  // namespace

double lens_radius(const Camera& camera) {
  return focus_distance(camera) * tangent(0.5 * camera.defocus_angle * radians);
}

CameraColumns camera_columns(const Camera& camera, int width, int height, Vec3d origin) {
  const Vec3d w = normalize(camera.look_from - camera.look_at);
  const Vec3d u = normalize(cross(camera.vup, w)), v = cross(w, u);
  const double focus = focus_distance(camera);
  const double view_height = 2 * tangent(0.5 * camera.vfov * radians) * focus;
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
  return std::visit([](const auto& kind) { return columns_of(kind); }, background);
}

Materials material_columns(const std::vector<Material>& materials) {
  Materials out;
  for (const Material& material : materials) {
    out.kind.push_back(static_cast<std::int32_t>(material.kind.index()));
    const auto* texture = std::get_if<TextureIndex>(&material.colour);
    const bool coloured = colour_name(material.kind) != nullptr;
    out.colour.push_back(coloured && !texture ? to_float(std::get<Vec3d>(material.colour)) : Vec3f{1, 1, 1});
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

Column<TextureColumns> texture_columns(const std::vector<Texture>& textures, Vec3d origin) {
  Column<TextureColumns> out;
  for (const Texture& texture : textures) {
    TextureColumns columns;
    columns.kind = static_cast<std::int32_t>(texture.kind.index());
    std::visit([&](const auto& t) { fill(columns, t, origin); }, texture.kind);
    out.push_back(columns);
  }
  return out;
}

Column<float> gradient_table() {
  Column<float> table;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const double z = 1 - 2 * unit_interval<double>(hash(2 * i + 1)),
                 phi = 2 * pi * unit_interval<double>(hash(2 * i + 2));
    const double r = std::sqrt(1 - z * z);
    for (const double c : {r * cosine(phi), r * sine(phi), z}) table.push_back(static_cast<float>(c));
  }
  return table;
}

Reciprocal reciprocal_edges(Vec3d u, Vec3d v) {
  const Vec3d n = cross(u, v);
  const double squared = dot(n, n);
  return {(1 / squared) * cross(v, n), (1 / squared) * cross(n, u)};
}

std::optional<Quad<>> frame_of_flat(const PlacedShape& placed) {
  return std::visit(
      []<class Shape>(const Shape& shape) -> std::optional<Quad<>> {
        if constexpr (std::is_same_v<Shape, Quad<>>)
          return shape;
        else if constexpr (has_outline<Shape>)
          return frame_of(shape);
        else
          return {};
      },
      placed.shape);
}

/// Corners and edges are those of the box in The Next Week, section 8.1.
BoxFace box_face_edges(const Box<>& b, std::int32_t face) {
  const Vec3d d = b.max - b.min, dx{d.x, 0, 0}, dy{0, d.y, 0}, dz{0, 0, d.z};
  const BoxFace faces[6] = {{{-1, 0, 0}, b.min, dz, dy},
                            {{1, 0, 0}, {b.max.x, b.min.y, b.max.z}, -dz, dy},
                            {{0, -1, 0}, b.min, dx, dz},
                            {{0, 1, 0}, {b.min.x, b.max.y, b.max.z}, dx, -dz},
                            {{0, 0, -1}, {b.max.x, b.min.y, b.min.z}, -dx, dy},
                            {{0, 0, 1}, {b.min.x, b.min.y, b.max.z}, dx, dy}};
  return faces[face];
}

Affine quad_map(const Quad<>& quad, const Placement& placement, Vec3d origin) {
  const Vec3d u = rotate(placement, quad.u), v = rotate(placement, quad.v);
  const Vec3d middle = place(placement, quad.corner) - origin + 0.5 * (u + v);
  const Reciprocal r = reciprocal_edges(u, v);
  Affine map;
  set_row(map, 0, 2.0 * r.a, middle);
  set_row(map, 1, 2.0 * r.b, middle);
  set_row(map, 2, normalize(cross(u, v)), middle);
  return map;
}

Affine triangle_map(const Triangle<>& t, const Placement& placement, Vec3d origin) {
  // hit_outlined() rounds a dozen times, each by at most 2^-24 of the coordinates or of the distance, which is at most
  // that of the start from the origin and that of the triangle from there.
  constexpr double rounding = 0x1p-19;
  Affine map = quad_map(frame_of(t), placement, origin);
  const Reciprocal r = reciprocal_edges(t.u, t.v);
  const auto scale = static_cast<float>(1 / (rounding * 2 * (length(r.a) + length(r.b))));
  map.row[2] = scale * map.row[2], map.offset[2] *= scale;
  return map;
}

Outline outline_in_scene(const Triangle<>& t, const Placement& placement, Vec3d origin) {
  double reach = 0;
  for (const Vec3d& corner : {t.corner, t.corner + t.u, t.corner + t.v})
    reach = std::max(reach, length(place(placement, corner) - origin));
  return {Outline::triangle, static_cast<float>(2 * reach)};
}

Affine box_map(const Box<>& box, const Placement& placement, Vec3d origin) {
  const Vec3d middle = place(placement, 0.5 * box.min + 0.5 * box.max) - origin, size = box.max - box.min;
  Affine map;
  set_row(map, 0, (2 / size.x) * rotate(placement, {1, 0, 0}), middle);
  set_row(map, 1, (2 / size.y) * rotate(placement, {0, 1, 0}), middle);
  set_row(map, 2, (2 / size.z) * rotate(placement, {0, 0, 1}), middle);
  return map;
}

void append_elements(const PlacedShape& shape, Vec3d origin, const SceneFeatures& features, const Checker<>* checker,
                     Elements& elements) {
  const Appender appender{shape, origin, features, checker, elements};
  if (const auto* sphere = std::get_if<Sphere<>>(&shape.shape)) appender.append_sphere(*sphere);
  each_face(shape, [&](const BoxFace& face, std::int32_t) { appender.append_flat(face); });
}

}  // namespace tyndall

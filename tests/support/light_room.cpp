#include "tests/support/light_room.h"

#include "core/base/kinds.h"

#include <algorithm>
#include <stdexcept>

namespace tyndall::test {
namespace {

constexpr double min_distance = 1e-9;         // shortest way of a ray from one surface to another
constexpr double min_distance_to_own = 1e-7;  // shortest way of a ray within a sphere from one point of it to another

/// Where a line is within something: from t0 to t1, if t0 < t1.
struct Stretch {
  double t0, t1;
};

Stretch cross_sphere(Vec3d center, double radius, Vec3d origin, Vec3d direction) {
  const Vec3d to_center = center - origin;
  const double middle = dot(to_center, direction);
  const Vec3d off = to_center - middle * direction;
  const double half_squared = radius * radius - dot(off, off);
  if (half_squared <= 0) return {1, 0};
  const double half = std::sqrt(half_squared);
  return {middle - half, middle + half};
}

Stretch cross_box(const Box<>& box, const Placement& placement, Vec3d origin, Vec3d direction) {
  const Placement back{-placement.degrees, {}};
  const Vec3d o = rotate(back, origin - placement.offset), d = rotate(back, direction);
  const double at[3] = {o.x, o.y, o.z}, step[3] = {d.x, d.y, d.z};
  const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
  Stretch inside{-1e300, 1e300};
  for (int axis = 0; axis < 3; ++axis) {
    if (step[axis] == 0) {
      if (at[axis] < low[axis] || at[axis] > high[axis]) return {1, 0};
      continue;
    }
    const double a = (low[axis] - at[axis]) / step[axis], b = (high[axis] - at[axis]) / step[axis];
    inside = {std::max(inside.t0, std::min(a, b)), std::min(inside.t1, std::max(a, b))};
  }
  return inside;
}

Stretch cross_volume(const PlacedVolume& volume, Vec3d origin, Vec3d direction) {
  const Stretch line = std::visit(
      Overloaded{[&](const Sphere<>& s) {
                   return cross_sphere(place(volume.placement, s.center), std::abs(s.radius), origin, direction);
                 },
                 [&](const Box<>& b) { return cross_box(b, volume.placement, origin, direction); }},
      volume.boundary);
  return {std::max(line.t0, 0.0), line.t1};
}

void refuse(bool wrong, const char* what) {
  if (wrong) throw std::invalid_argument(std::string("light_room: ") + what + " is not covered");
}

/// A point of a surface in pictures laid on it; closed: u goes on from 1 to 0.
struct SurfacePlace {
  double u = 0, v = 0;
  bool closed = false;
};

/// Bilinear between the middles of texels. What is not closed ends at the edges, and so does v; v = 1 is the top row.
Vec3d image_at(const Image& image, const SurfacePlace& at) {
  const auto& pixels = *image.pixels;
  const auto [u, v, closed] = at;
  const double x =
      closed ? (u - std::floor(u)) * pixels.width - 0.5 : std::clamp(u * pixels.width - 0.5, 0.0, pixels.width - 1.0);
  const double y = std::clamp((1 - v) * pixels.height - 0.5, 0.0, pixels.height - 1.0);
  const auto texel = [&](double column, double row) {
    const int i = (static_cast<int>(column) + pixels.width) % pixels.width;
    const int j = std::min(static_cast<int>(row), pixels.height - 1);
    const float* rgb = &pixels.rgb[static_cast<std::size_t>(3 * (j * pixels.width + i))];
    return Vec3d{static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
  };
  const double i = std::floor(x), j = std::floor(y), a = x - i, b = y - j;
  return (1 - b) * ((1 - a) * texel(i, j) + a * texel(i + 1, j)) +
         b * ((1 - a) * texel(i, j + 1) + a * texel(i + 1, j + 1));
}

bool is_odd(const Checker<>& checker, Vec3d p) {
  const double sum =
      std::floor(p.x / checker.scale) + std::floor(p.y / checker.scale) + std::floor(p.z / checker.scale);
  return std::fmod(std::abs(sum), 2.0) == 1;
}

/// The colour of a texture at a point; uv(): the place of the surface there.
Vec3d colour_of(const Scene& scene, const ColourOrTexture& colour, Vec3d point, auto uv) {
  if (const auto* plain = std::get_if<Vec3d>(&colour)) return *plain;
  const auto index = static_cast<std::size_t>(std::get<TextureIndex>(colour).index);
  return std::visit(Overloaded{[](const Solid<>& solid) { return solid.color; },
                               [&](const Checker<>& c) { return is_odd(c, point) ? c.odd : c.even; },
                               [](const Noise<>&) {
                                 refuse(true, "noise");
                                 return Vec3d{};
                               },
                               [&](const Image& image) { return image_at(image, uv()); }},
                    scene.textures[index].kind);
}

}  // namespace

double RoomSurface::area() const { return round ? 4 * pi * radius * radius : length(cross(u, v)); }

LightRoom::LightRoom(const Scene& scene) : scene_(scene) {
  refuse(scene.camera.defocus_angle > 0, "a lens");
  refuse(scene.render.fresnel != FresnelKind::exact, "Schlick's rule");
  refuse(scene.background != Background(Vec3d{0, 0, 0}), "a background that is not black");
  const Flattened flat = flatten(scene);
  for (const PlacedShape& placed : flat.shapes) add(placed);
  media = flat.volumes;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (std::holds_alternative<Light<>>(kind(surfaces[i]))) lamps.push_back(static_cast<int>(i));
    if (surfaces[i].round && is_smooth(surfaces[i])) balls.push_back(static_cast<int>(i));
  }
}

void LightRoom::add(const PlacedShape& placed) {
  std::visit(
      Overloaded{[&](const Sphere<>& s) {
                   RoomSurface out;
                   out.round = true, out.radius = s.radius, out.placement = placed.placement;
                   out.center = place(placed.placement, s.center);
                   if (s.center_end) out.motion = place(placed.placement, *s.center_end) - out.center;
                   out.material = placed.material;
                   surfaces.push_back(out);
                 },
                 [&](const Quad<>& q) { add_flat(placed, q.corner, q.u, q.v); },
                 [](const Triangle<>&) { refuse(true, "a triangle"); }, [](const Disk<>&) { refuse(true, "a disk"); },
                 [&](const Box<>& b) {
                   const Vec3d x{b.max.x - b.min.x, 0, 0}, y{0, b.max.y - b.min.y, 0}, z{0, 0, b.max.z - b.min.z};
                   add_flat(placed, b.min, y, x), add_flat(placed, b.min + z, x, y);
                   add_flat(placed, b.min, x, z), add_flat(placed, b.min + y, z, x);
                   add_flat(placed, b.min, z, y), add_flat(placed, b.min + x, y, z);
                 }},
      placed.shape);
}

void LightRoom::add_flat(const PlacedShape& placed, Vec3d corner, Vec3d u, Vec3d v) {
  RoomSurface out;
  out.corner = place(placed.placement, corner), out.u = rotate(placed.placement, u),
  out.v = rotate(placed.placement, v);
  const Vec3d n = cross(out.u, out.v);
  out.normal = normalize(n);
  out.along_u = (1 / dot(n, n)) * cross(out.v, n), out.along_v = (1 / dot(n, n)) * cross(n, out.u);
  out.material = placed.material;
  surfaces.push_back(out);
}

bool LightRoom::is_smooth(const RoomSurface& surface) const {
  const auto* metal = std::get_if<Metal<>>(&kind(surface));
  return std::holds_alternative<Dielectric<>>(kind(surface)) || (metal && metal->fuzz == 0);
}

RoomHit LightRoom::closest(Vec3d origin, Vec3d direction, double time, int last, double limit) const {
  RoomHit hit;
  hit.t = limit;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const RoomSurface& s = surfaces[i];
    const bool own = static_cast<int>(i) == last;
    double t = 0;
    if (s.round) {
      const Stretch line = cross_sphere(s.center_at(time), std::abs(s.radius), origin, direction);
      const double minimum = own ? min_distance_to_own : min_distance;
      t = line.t0 > minimum ? line.t0 : line.t1;
      if (line.t0 >= line.t1 || t <= minimum || t >= hit.t) continue;
      hit.normal = (1 / s.radius) * (origin + t * direction - s.center_at(time));
    } else {
      const double slope = dot(s.normal, direction);
      if (own || slope == 0) continue;
      t = dot(s.normal, s.corner - origin) / slope;
      if (!(t > min_distance && t < hit.t)) continue;
      const Vec3d at = origin + t * direction - s.corner;
      const double a = dot(s.along_u, at), b = dot(s.along_v, at);
      if (a < 0 || a > 1 || b < 0 || b > 1) continue;
      hit.normal = s.normal;
    }
    hit.t = t, hit.surface = static_cast<int>(i);
  }
  return hit;
}

double LightRoom::transmittance(Vec3d origin, Vec3d direction, double distance) const {
  double depth = 0;
  for (const PlacedVolume& volume : media) {
    const Stretch line = cross_volume(volume, origin, direction);
    depth += volume.medium.density * std::max(std::min(line.t1, distance) - line.t0, 0.0);
  }
  return std::exp(-depth);
}

int LightRoom::fly(Vec3d origin, Vec3d direction, double& limit, SplitMix& random) const {
  int found = -1;
  for (std::size_t i = 0; i < media.size(); ++i) {
    const Stretch line = cross_volume(media[i], origin, direction);
    const double t = line.t0 - std::log(random()) / media[i].medium.density;
    if (line.t0 >= line.t1 || t >= std::min(line.t1, limit)) continue;
    limit = t, found = static_cast<int>(i);
  }
  return found;
}

Vec3d LightRoom::colour(const RoomSurface& surface, Vec3d point, double time) const {
  const auto uv = [&] {
    if (!surface.round) {
      const Vec3d at = point - surface.corner;
      return SurfacePlace{dot(surface.along_u, at), dot(surface.along_v, at), false};
    }
    const Vec3d out =
        (1 / std::abs(surface.radius)) * rotate({-surface.placement.degrees, {}}, point - surface.center_at(time));
    return SurfacePlace{(std::atan2(-out.z, out.x) + pi) / (2 * pi), std::acos(std::clamp(-out.y, -1.0, 1.0)) / pi,
                        true};
  };
  return colour_of(scene_, scene_.materials[static_cast<std::size_t>(surface.material)].colour, point, uv);
}

Vec3d LightRoom::colour(const PlacedVolume& volume, Vec3d point) const {
  return colour_of(scene_, volume.albedo, point, [] { return SurfacePlace{}; });
}

}  // namespace tyndall::test

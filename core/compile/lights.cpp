#include "core/compile/lights.h"

#include "core/base/math.h"
#include "core/compile/columns.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

struct Emitter {
  double brightness;  // the largest component of its radiance
  std::int32_t element;
};

void push_common(Lights& out, const Emitter& e, double area, Vec3d center, double reach) {
  out.element.push_back(e.element);
  out.area.push_back(static_cast<float>(area));
  push(out.center, center);
  out.power.push_back(static_cast<float>(area * e.brightness));
  out.reach2.push_back(static_cast<float>(reach * reach));
}

void add_flat(Lights& out, const Emitter& e, Vec3d corner, Vec3d u, Vec3d v) {
  const double a = length(u), b = length(v);
  const Vec3d n = cross(u, v);
  const bool square = std::abs(dot(u, v)) <= 1e-6 * a * b;
  out.kind.push_back(square ? Lights::rectangle : Lights::parallelogram);
  push(out.corner, corner);
  push(out.edge_u, (1 / a) * u);
  push(out.edge_v, (1 / b) * v);
  push(out.normal, (1 / length(n)) * n);
  out.length_u.push_back(static_cast<float>(a));
  out.length_v.push_back(static_cast<float>(b));
  push_common(out, e, length(n), corner + 0.5 * (u + v), 0.5 * std::max(length(u + v), length(u - v)));
}

struct Collector {
  Lights& out;
  const Placement& placement;
  Vec3d origin;
  Emitter emitter;

  void operator()(const Sphere<>& s) const {
    const double r = std::abs(s.radius);
    const Vec3d center = place(placement, s.center) - origin;
    const Vec3d way = s.center_end ? turn(placement, *s.center_end - s.center) : Vec3d{};
    out.kind.push_back(Lights::sphere);
    push(out.corner, center);
    push(out.edge_u, way);
    push(out.edge_v, {});
    push(out.normal, {});
    out.length_u.push_back(static_cast<float>(r));
    out.length_v.push_back(0);
    push_common(out, emitter, 4 * pi * r * r, center + 0.5 * way, r + 0.5 * length(way));
  }
  void operator()(const Quad<>& q) const {
    add_flat(out, emitter, place(placement, q.corner) - origin, turn(placement, q.u), turn(placement, q.v));
  }
  void operator()(const Box<>& b) const {
    for (std::int32_t i = 0; i < 6; ++i) {
      const BoxFace face = box_face_edges(b, i);
      add_flat(out, {emitter.brightness, emitter.element + i}, place(placement, face.corner) - origin,
               turn(placement, face.u), turn(placement, face.v));
    }
  }
};

double brightness_of(const Material& m) {
  if (!std::holds_alternative<Light<>>(m.kind)) return 0;
  const auto* colour = std::get_if<Vec3d>(&m.colour);
  return colour ? std::max({colour->x, colour->y, colour->z}) : 1.0;
}

}  // namespace

void build_alias_table(Lights& out) {
  const std::size_t n = out.power.size();
  double sum = 0;
  for (const float p : out.power) sum += static_cast<double>(p);
  std::vector<double> scaled(n);
  std::vector<std::size_t> small, large;
  out.probability.resize(n), out.keep.assign(n, 1), out.alias.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out.probability[i] = static_cast<float>(static_cast<double>(out.power[i]) / sum);
    out.alias[i] = static_cast<std::int32_t>(i);
    scaled[i] = static_cast<double>(out.power[i]) / sum * static_cast<double>(n);
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t s = small.back(), l = large.back();
    small.pop_back();
    out.keep[s] = static_cast<float>(scaled[s]);
    out.alias[s] = static_cast<std::int32_t>(l);
    scaled[l] -= 1 - scaled[s];
    if (scaled[l] >= 1) continue;
    large.pop_back();
    small.push_back(l);
  }
}

Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements) {
  Lights out;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    const double brightness = brightness_of(scene.materials[static_cast<std::size_t>(shape.material)]);
    if (!(brightness > 0)) continue;
    std::visit(Collector{out, shape.placement, origin, {brightness, first_element[i]}}, shape.shape);
  }
  elements.light.assign(elements.material.size(), -1);
  for (int k = 0; k < out.count(); ++k)
    elements.light[static_cast<std::size_t>(out.element[static_cast<std::size_t>(k)])] = k;
  build_alias_table(out);
  return out;
}

}  // namespace tyndall

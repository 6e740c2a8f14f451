#include "core/compile/columns.h"

#include "core/base/math.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

/// The columns of a light but its outline; see Lights.
struct LightEntry {
  Lights::Kind kind;
  Vec3d corner, edge_u, edge_v, normal;
  double length_u, length_v, area;
  Vec3d center;
  double reach2;
};

LightEntry flat_light(Vec3d corner, Vec3d u, Vec3d v) {
  const double a = length(u), b = length(v), reach = 0.5 * std::max(length(u + v), length(u - v));
  const Vec3d n = cross(u, v);
  const bool square = std::abs(dot(u, v)) <= 1e-6 * a * b;
  return {square ? Lights::rectangle : Lights::parallelogram,
          corner,
          (1 / a) * u,
          (1 / b) * v,
          (1 / length(n)) * n,
          a,
          b,
          length(n),
          corner + 0.5 * (u + v),
          reach * reach};
}

LightEntry sphere_light(const Sphere<>& s, const Placement& placement, Vec3d origin) {
  const Vec3d center = place(placement, s.center) - origin;
  const Vec3d motion = s.center_end ? rotate(placement, *s.center_end - s.center) : Vec3d{};
  const double r = std::abs(s.radius), reach = r + 0.5 * length(motion);
  return {Lights::sphere, center, motion, {}, {}, r, 0, 4 * pi * r * r, center + 0.5 * motion, reach * reach};
}

/// Squared radius of a sphere around the middle of the frame that holds the shape.
double reach2_of(const Triangle<>& t) { return 0.25 * std::max(dot(t.u + t.v, t.u + t.v), dot(t.u - t.v, t.u - t.v)); }
double reach2_of(const Disk<>& d) {  // the square of the longer half axis of the ellipse
  const double a = dot(d.u, d.u), b = dot(d.v, d.v);
  return 0.5 * (a + b) + length(Vec3d{0.5 * (a - b), dot(d.u, d.v), 0});
}

void append(Lights& out, const LightEntry& light, double brightness, std::int32_t element) {
  out.kind.push_back(light.kind);
  out.element.push_back(element);
  out.corner.push_back(to_float(light.corner));
  out.edge_u.push_back(to_float(light.edge_u));
  out.edge_v.push_back(to_float(light.edge_v));
  out.normal.push_back(to_float(light.normal));
  out.length_u.push_back(static_cast<float>(light.length_u));
  out.length_v.push_back(static_cast<float>(light.length_v));
  out.area.push_back(static_cast<float>(light.area));
  out.center.push_back(to_float(light.center));
  out.power.push_back(static_cast<float>(light.area * brightness));
  out.reach2.push_back(static_cast<float>(light.reach2));
}

/// Appends the lights of a shape whose first element is given.
void append_lights(Lights& out, const PlacedShape& placed, double brightness, std::int32_t first, Vec3d origin) {
  std::visit(
      [&]<class Shape>(const Shape& shape) {
        if constexpr (std::is_same_v<Shape, Sphere<>>)
          return append(out, sphere_light(shape, placed.placement, origin), brightness, first);
        each_face(placed, [&](const BoxFace& face, std::int32_t i) {
          LightEntry light = flat_light(face.corner - origin, face.u, face.v);
          if constexpr (has_outline<Shape>) {
            const Outline outline = outline_of(shape);
            light.kind = outline.kind == Outline::triangle ? Lights::triangle : Lights::ring;
            light.area = area_fraction(outline) * static_cast<double>(static_cast<float>(light.area));
            light.reach2 = reach2_of(shape);
            out.inner.resize(out.kind.size());
            out.inner.push_back(outline.size);
          }
          append(out, light, brightness, first + i);
        });
      },
      placed.shape);
}

/// Builds a LightTree from the top.
class TreeBuilder {
 public:
  explicit TreeBuilder(const Lights& lights) : lights_(lights) {
    for (int k = 0; k < lights.count(); ++k) order_.push_back(k);
    tree_.leaf.resize(order_.size());
  }

  LightTree build() {
    add_pair(-1);
    build({0, 0, order_.size(), 0});
    return std::move(tree_);
  }

 private:
  /// The node whose lights are order_[begin] ... order_[end - 1].
  struct Range {
    std::size_t node, begin, end;
    int depth;
  };
  /// A box around spheres, and their power.
  struct Sum {
    Vec3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    double power = 0;
    void add(Vec3d center, double reach, double more) {
      low = {std::min(low.x, center.x - reach), std::min(low.y, center.y - reach), std::min(low.z, center.z - reach)};
      high = {std::max(high.x, center.x + reach), std::max(high.y, center.y + reach),
              std::max(high.z, center.z + reach)};
      power += more;
    }
    double cost() const { return power * dot(high - low, high - low); }
  };
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// Fraction of the squared half diagonal at which the mean inverse squared distance to the lights of a node, as seen
  /// from among them, is about right. For lights spread evenly in a sphere the mean is 3 / radius², and a cube's
  /// squared half diagonal is twice the squared radius of a sphere as large. With 1, which is never too much, V was 1.5
  /// to 3.3 times higher.
  static constexpr double closeness = 1.0 / 6;
  static constexpr int deepest_by_cost = 48;  // below, ranges are halved, so that no tree is deeper than 80

  Vec3d center(std::int32_t light) const { return to_double(lights_.center[light]); }
  double power(std::int32_t light) const { return static_cast<double>(lights_.power[light]); }
  double reach2(std::int32_t light) const { return static_cast<double>(lights_.reach2[light]); }
  void add(std::int32_t light, Sum& sum) const { sum.add(center(light), std::sqrt(reach2(light)), power(light)); }

  void build(const Range& range) {
    fill(range);
    if (range.end - range.begin == 1) return;
    const std::size_t middle = split(range), first = add_pair(static_cast<std::int32_t>(range.node));
    tree_.child[range.node] = static_cast<std::int32_t>(first);
    build({first, range.begin, middle, range.depth + 1});
    build({first + 1, middle, range.end, range.depth + 1});
  }

  std::size_t add_pair(std::int32_t parent) {
    const std::size_t first = tree_.power.size();
    for (Column<float>* column : {&tree_.center.x, &tree_.center.y, &tree_.center.z, &tree_.power, &tree_.reach2})
      column->resize(first + 2);
    tree_.child.resize(first + 2, -1), tree_.parent.resize(first + 2, parent);
    return first;
  }

  void fill(const Range& range) {
    const auto put = [&](Vec3d middle, double power, double reach2) {
      tree_.center.set(range.node, to_float(middle));
      tree_.power[range.node] = static_cast<float>(power), tree_.reach2[range.node] = static_cast<float>(reach2);
    };
    if (range.end - range.begin == 1) {
      const std::int32_t light = order_[range.begin];
      tree_.child[range.node] = -1 - light, tree_.leaf[light] = static_cast<std::int32_t>(range.node);
      return put(center(light), power(light), reach2(light));
    }
    Sum all;
    for (std::size_t i = range.begin; i < range.end; ++i) add(order_[i], all);
    const Vec3d half = 0.5 * (all.high - all.low);
    put(all.low + half, all.power, closeness * dot(half, half));
  }

  /// Orders a range along its longest axis and returns where its second part begins.
  std::size_t split(const Range& range) {
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(range.begin),
               last = order_.begin() + static_cast<std::ptrdiff_t>(range.end);
    Sum centers;
    for (auto i = first; i < last; ++i) centers.add(center(*i), 0, 0);
    const Vec3d extent = centers.high - centers.low;
    const auto along_axis = [&](std::int32_t light) {
      const Vec3d c = center(light);
      return extent.x >= extent.y && extent.x >= extent.z ? c.x : extent.y >= extent.z ? c.y : c.z;
    };
    std::sort(first, last, [&](std::int32_t a, std::int32_t b) {
      return along_axis(a) < along_axis(b) || (along_axis(a) == along_axis(b) && a < b);
    });
    const std::size_t count = range.end - range.begin;
    if (range.depth >= deepest_by_cost) return range.begin + count / 2;
    std::vector<double> right(count);
    Sum sum;
    for (std::size_t i = count - 1; i > 0; --i) add(first[static_cast<std::ptrdiff_t>(i)], sum), right[i] = sum.cost();
    Sum left;
    std::size_t best = count / 2;
    double minimum = infinity;
    for (std::size_t i = 1; i < count; ++i) {
      add(first[static_cast<std::ptrdiff_t>(i) - 1], left);
      if (left.cost() + right[i] < minimum) minimum = left.cost() + right[i], best = i;
    }
    return range.begin + best;
  }

  const Lights& lights_;
  std::vector<std::int32_t> order_;
  LightTree tree_;
};

// The conditions in columns.h, as numbers.
constexpr float nearness = 1.5f;     // largest distance of a light from the medium's centre, in half widths of it
constexpr float small_light = 0.1f;  // largest radius of the light over the half width and over its camera distance
constexpr float max_free_paths = 4;  // largest half width of the medium, in mean free paths

struct Place {
  float outside;     // distance from the medium's centre, in half widths
  float half_width;  // the smallest of the three axes
};

Place place_of(const MediumColumns& m, Vec3f point) {
  if (!m.box) return {length(point - m.center) / m.radius, m.radius};
  Place place{0, std::numeric_limits<float>::infinity()};
  for (int i = 0; i < 3; ++i) {
    place.outside = std::max(place.outside, std::abs(affine_point<float>(m.map, i, point)));
    place.half_width = std::min(place.half_width, 1 / length(m.map.row[i]));
  }
  return place;
}

bool pays(const MediumColumns& m, Vec3f light, float reach, Vec3f camera) {
  const Place place = place_of(m, light);
  const bool scatters = m.texture >= 0 || !(m.albedo == Vec3f{0, 0, 0});
  return scatters && m.density * place.half_width <= max_free_paths && place.outside <= nearness &&
         reach <= small_light * std::min(place.half_width, length(light - camera));
}

}  // namespace

double brightness_of(const Material& m) {
  if (!traits_of(m.kind).emits) return 0;
  const auto* colour = std::get_if<Vec3d>(&m.colour);
  return colour ? max_component(*colour) : 1.0;
}

void build_light_tree(Lights& lights) {
  if (lights.count() > max_lights_by_contribution) lights.tree = TreeBuilder(lights).build();
}

Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements) {
  Lights out;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    const double brightness = brightness_of(scene.materials[static_cast<std::size_t>(shape.material)]);
    if (brightness > 0) append_lights(out, shape, brightness, first_element[i], origin);
  }
  elements.light.assign(elements.material.size(), -1);
  for (int k = 0; k < out.count(); ++k) elements.light[out.element[k]] = k;
  if (!out.inner.empty()) out.inner.resize(out.kind.size());
  build_light_tree(out);
  return out;
}

NearLights find_near_lights(const RenderScene& s) {
  NearLights near;
  for (int m = 0; m < s.media.count(); ++m)
    for (int k = 0; k < s.lights.count(); ++k)
      if (pays(s.media[m], s.lights.center[k], std::sqrt(s.lights.reach2[k]), s.camera.center))
        near.medium.push_back(m), near.light.push_back(k);
  if (near.medium.empty()) return near;
  near.probability.assign(s.media.size() * s.lights.kind.size(), 0);
  for (int i = 0; i < near.medium.count(); ++i)
    near.probability[near.medium[i] * s.lights.count() + near.light[i]] = 1 / static_cast<float>(near.medium.size());
  return near;
}

}  // namespace tyndall

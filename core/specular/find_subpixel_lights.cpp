// Compiled like the scalar kernel, so that every instruction set gets the same boxes.
#include "core/specular/find_subpixel_lights.h"

#include "core/specular/specular_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>

namespace tyndall {
namespace {

constexpr int max_pairs = 32;            // at most, so that an edit stays quick
constexpr int max_reflections = 4;       // in an event sequence; more carry too little light to be seen
constexpr int max_roots = 4;             // paths of one event sequence between two points
constexpr float min_throughput = 1e-6f;  // event sequences of less are left out
constexpr float rare_throughput = 0.1f;  // the whole image of an event sequence of less is steered to
constexpr std::ptrdiff_t max_in_pixel = 16;
constexpr float largest = 16;         // size of a box, in pixels
constexpr float margin = 0.1f;        // of a box, on each side: the box is found from a few points of the light only
constexpr float uncertainty = 4e-6f;  // of directions, in radians

/// SubpixelLight::route of a path with so many reflections and crossings of surfaces; 0: it is not steered.
std::int32_t route_by(int reflections, int crossings) {
  return reflections > 0 ? pack_route(reflections, std::min(crossings, 15)) : 0;
}

/// The light's middle, and points around it.
std::vector<Vec3f> points_of(const LightColumns<float>& light) {
  std::vector<Vec3f> points;
  if (light.kind != Lights::sphere) {
    for (const float u : {0.5f, 0.0f, 1.0f})
      for (const float v : {0.5f, 0.0f, 1.0f})
        points.push_back(light.corner + u * light.length_u * light.edge_u + v * light.length_v * light.edge_v);
    return points;
  }
  const Vec3f center = sphere_light_center(light, 0.0f);
  points.push_back(center);
  for (const float x : {-1.0f, 0.0f, 1.0f})
    for (const float y : {-1.0f, 0.0f, 1.0f})
      for (const float z : {-1.0f, 0.0f, 1.0f}) {
        const Vec3f corner{x, y, z};
        const float far = length(corner);
        if (far > 0) points.push_back(center + (light.length_u / far) * corner);
      }
  return points;
}

class Finder {
 public:
  explicit Finder(const SceneView& s) : s_(s) {}

  /// Adds the boxes of all lights that a specular object may show, as the camera sees them directly and by the object.
  void find() {
    const auto directly = [&](Vec3f point, int) {
      SpecularPath<float> path{};
      path.found = true, path.direction = point - s_.camera.center;
      return path;
    };
    std::set<std::int32_t> seen;
    for (int k = 0; k < std::min(s_.specular.pairs(), max_pairs); ++k) {
      const std::int32_t sphere = s_.specular.sphere[k], light = s_.specular.light[k];
      light_ = load_light_or_sun<float>(s_, light, load_sphere<float>(s_.specular, sphere, 0.0f));
      points_ = points_of(light_);
      if (light >= 0 && seen.insert(light).second) add(directly, 1, 0);
      if (sphere < s_.specular.first_mirror)
        by_sphere(sphere);
      else if (sphere < s_.specular.first_slab)
        by_mirror(load_flat<float>(s_.specular, sphere - s_.specular.first_mirror));
      else
        by_slab(load_flat<float>(s_.specular, sphere - s_.specular.first_mirror));
    }
  }

  std::vector<PictureBox> boxes;

 private:
  /// Adds the boxes of `roots` images. see(point, root): the path by which image `root` shows a point of the light.
  void add(auto see, int roots, std::int32_t route) {
    for (int root = 0; root < roots; ++root) {
      PictureBox box;
      box.route = route;
      for (const Vec3f& point : points_) {
        Pair<float> at{};
        const SpecularPath<float> seen = see(point, root);
        if (seen.found && seen.throughput >= min_throughput && project(s_.camera, seen.direction, at)) box.include(at);
        // Most images are not in the picture. The light's middle, which comes first, tells.
        if (&point != points_.data()) continue;
        if (!is_near_picture(box)) break;
        box.throughput = seen.throughput;
      }
      if (is_near_picture(box)) boxes.push_back(box);
    }
  }

  bool is_near_picture(const PictureBox& box) const {
    return !box.empty() && box.right > -1 && box.left < static_cast<float>(s_.width) + 1 && box.bottom > -1 &&
           box.top < static_cast<float>(s_.height) + 1;
  }

  void by_mirror(const SpecularFlat<float>& mirror) {
    add([&](Vec3f point, int) { return mirror_path(mirror, s_.camera.center, point); }, 1, 0);
  }

  /// Straight through, reflected off the outside, and reflected inside, between the faces at the ends of each edge.
  void by_slab(const SpecularFlat<float>& slab) {
    for (std::int32_t across = 0; across < 3; ++across)
      for (int crossings = 0; crossings <= max_reflections + 1; ++crossings) {
        const auto see = [&](Vec3f point, int) {
          const SlabFrame<float> ends = slab_frame(slab, s_.camera.center, point, across);
          SpecularPath<float> path = slab_path(slab, ends, {across, static_cast<float>(crossings), {0, 0}});
          path.found = path.found && ends.near_gap > 0 && ends.far_gap > 0 && ends.same == (crossings % 2 == 0);
          return path;
        };
        add(see, 1, crossings == 0 ? route_by(1, 0) : route_by(crossings - 1, 2));
      }
  }

  void by_sphere(std::int32_t sphere) {
    query_ = {};
    query_.sphere = load_sphere<float>(s_.specular, sphere, 0.0f);
    query_.light_columns = light_;
    if (!aim_at(points_.front())) return;
    const bool hollow = query_.sphere.hollow, both_out = query_.ends.both_out;
    if (both_out) by_sequence({1, 0, 0});
    if (query_.sphere.mirror) return;
    for (int reflections = 0; reflections <= max_reflections; ++reflections) {
      if (hollow) by_layers(reflections);
      if (!hollow || (both_out && is_thick(query_.sphere))) by_sequence(sequence_of(reflections, 0, 0));
    }
  }

  /// Event sequences that meet a shell's inner sphere, with a given number of reflections at the outer one. On each
  /// pass through the shell, from the outer sphere to the outer sphere, light is reflected at the inner sphere or goes
  /// through it, perhaps with reflections inside.
  void by_layers(int reflections) {
    const int passes = reflections + crossings() - 1, halves = 2 - crossings();
    for (int reflected = 0; reflected <= passes; ++reflected) {
      const int through = 2 * (passes - reflected) + halves,
                maximum = through > 0 ? max_reflections - reflections - reflected : 0;
      for (int within = 0; within <= maximum; ++within)
        by_sequence(sequence_of(reflections, reflected + through + within, reflected + within));
    }
  }

  /// How often light crosses the outer sphere: 2, or 1 with an end inside.
  int crossings() const { return query_.ends.both_out ? 2 : 1; }

  EventSequence<float> sequence_of(int outer_reflected, int inner, int inner_reflected) const {
    return {static_cast<float>(crossings() + outer_reflected), static_cast<float>(inner),
            static_cast<float>(inner_reflected)};
  }

  /// Makes the query one of paths from the camera by the sphere to that point of the light. Returns whether there may
  /// be some, and not only in the direction of the sphere's centre, where no plane of the path is defined.
  bool aim_at(Vec3f point) {
    query_.at.point = point;
    query_.plane = plane_of(query_.sphere, s_.camera.center, point);
    query_.ends = ends_of(query_.sphere, query_.plane.near, query_.plane.far);
    return query_.ends.valid && !query_.ends.both_in && query_.plane.sine > 1e-7f;
  }

  /// Tries both signs of an end inside the sphere: see EndSigns.
  void by_sequence(const EventSequence<float>& sequence) {
    const bool near_in = query_.plane.near < query_.sphere.radius;
    add_sequence(sequence, {1, 1});
    if (!query_.ends.both_out) add_sequence(sequence, near_in ? EndSigns<float>{-1, 1} : EndSigns<float>{1, -1});
  }

  /// Adds the images of the light by one event sequence: one for each root of its deflection.
  void add_sequence(const EventSequence<float>& sequence, EndSigns<float> sign) {
    const auto see = [&](Vec3f point, int root) -> SpecularPath<float> {
      if (!aim_at(point)) return {};
      SolvedPath<float> found{deflection_of(s_.specular, query_.sphere, query_.ends, sequence, sign), sign, {}};
      if (!found.deflection.possible) return {};
      const DeflectionRoots<float> roots = list_roots(found.deflection, query_.plane.angle, true);
      found.root = take_root(found.deflection, roots, query_.plane.angle, static_cast<float>(root));
      return sphere_path(query_, sequence, found);
    };
    add(see, max_roots, route_of(sequence));
    aim_at(points_.front());
  }

  /// SubpixelLight::route of an event sequence. 0 for paths that start inside the glass, which are not steered.
  std::int32_t route_of(const EventSequence<float>& w) const {
    if (query_.sphere.mirror || query_.plane.near < query_.sphere.radius) return 0;
    if (w.outer < static_cast<float>(crossings())) return route_by(1, 0);  // off the outside of the glass
    const int reflections = static_cast<int>(w.outer + w.inner_reflected) - crossings();
    return route_by(reflections, static_cast<int>(w.outer + w.inner) - reflections);
  }

  const SceneView& s_;
  LightColumns<float> light_{};
  std::vector<Vec3f> points_;  // of the light, its middle first
  SpecularQuery<float> query_{};
};

struct WeighedSubpixelLight {
  SubpixelLight subpixel_light;
  float weight;  // relative to the others in its pixel
};

/// Adds the parts of a box that fill less than half of their pixel: samples hit larger parts often enough. Adds all
/// parts of a box to which glass sends little light, because samples there seldom take that path.
void cut(PictureBox box, float pixel_angle, const SceneView& s, std::vector<WeighedSubpixelLight>& subpixel_lights) {
  const float extra = uncertainty / pixel_angle;
  const float wide = margin * (box.right - box.left) + extra, high = margin * (box.bottom - box.top) + extra;
  box.left -= wide, box.right += wide, box.top -= high, box.bottom += high;
  if (!(box.right - box.left < largest && box.bottom - box.top < largest)) return;
  for (float y = std::max(std::floor(box.top), 0.0f); y < box.bottom && y < static_cast<float>(s.height); ++y)
    for (float x = std::max(std::floor(box.left), 0.0f); x < box.right && x < static_cast<float>(s.width); ++x) {
      SubpixelLight g{x, y, std::max(box.left - x, 0.0f), std::max(box.top - y, 0.0f), 0, 0, 0, 0, 0, box.route};
      g.width = std::min(box.right - x, 1.0f) - g.left, g.height = std::min(box.bottom - y, 1.0f) - g.top;
      const bool seldom_met = g.width * g.height < 0.5f || (box.route > 0 && box.throughput < rare_throughput);
      if (g.width > 0 && g.height > 0 && seldom_met)
        subpixel_lights.push_back({g, std::sqrt(std::sqrt(box.throughput))});
    }
}

/// Gives each subpixel light a fraction of the samples drawn within boxes of its pixel, by weight: the fourth root of
/// its throughput. By the throughput itself, the darkest would be met by single samples that count for much.
std::vector<SubpixelLight> distribute(std::vector<WeighedSubpixelLight> subpixel_lights) {
  const auto order = [](const WeighedSubpixelLight& g) {
    return std::tuple(g.subpixel_light.y, g.subpixel_light.x, -g.weight);
  };
  std::stable_sort(subpixel_lights.begin(), subpixel_lights.end(),
                   [&](const auto& a, const auto& b) { return order(a) < order(b); });
  std::vector<SubpixelLight> out;
  for (auto first = subpixel_lights.begin(); first != subpixel_lights.end();) {
    const auto next = std::find_if(first, subpixel_lights.end(), [first](const WeighedSubpixelLight& g) {
      return g.subpixel_light.y != first->subpixel_light.y || g.subpixel_light.x != first->subpixel_light.x;
    });
    const auto last = first + std::min<std::ptrdiff_t>(next - first, max_in_pixel);
    const auto add = [](float sum, const WeighedSubpixelLight& g) { return sum + g.weight; };
    const float scale = subpixel_light_fraction / std::accumulate(first, last, 0.0f, add);
    float begin = 0, weight = 0;
    for (auto at = first; at != last; ++at) {
      SubpixelLight g = at->subpixel_light;
      weight += at->weight;
      g.begin = begin, g.end = begin = at + 1 == last ? subpixel_light_fraction : scale * weight;
      g.pdf = (g.end - g.begin) / (g.width * g.height);
      if (g.begin < g.end) out.push_back(g);
    }
    first = next;
  }
  return out;
}

}  // namespace

std::vector<SubpixelLight> find_subpixel_lights(const SceneView& scene, const std::vector<PictureBox>& others) {
  if (scene.features.lens || scene.features.shutter) return {};
  Finder finder(scene);
  finder.boxes = others;
  finder.find();
  const float pixel_angle = length(scene.camera.du) / length(scene.camera.corner);
  std::vector<WeighedSubpixelLight> subpixel_lights;
  for (const PictureBox& box : finder.boxes) cut(box, pixel_angle, scene, subpixel_lights);
  return distribute(std::move(subpixel_lights));
}

}  // namespace tyndall

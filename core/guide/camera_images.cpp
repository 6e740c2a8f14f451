#include "core/guide/camera_images.h"

#include "core/compile/columns.h"
#include "core/guide/light_image.h"
#include "core/guide/nearby_rays.h"
#include "core/guide/things.h"
#include "core/trace/camera.h"
#include "core/trace/intersect.h"
#include "core/trace/light_choice.h"
#include "core/trace/shade.h"

#include <algorithm>
#include <set>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t max_boxes = 64;  // because all samples of a row of tiles look at all boxes there

using Events = std::vector<std::int32_t>;  // indices of the things that reflect, from the camera on

/// Length of a row of a matrix.
double first_row(Matrix m) { return std::sqrt(m.a * m.a + m.b * m.b); }
double second_row(Matrix m) { return std::sqrt(m.c * m.c + m.d * m.d); }

/// A path from the camera through a place of the picture, with rays beside it: two through places nearby, and two more
/// rotated at each fuzzy reflection.
class CameraPath {
 public:
  CameraPath(const SceneView& s, double x, double y) : s_(s), x_(x), y_(y) {
    const Vec3d du = to_double(s.camera.du), dv = to_double(s.camera.dv), center = to_double(s.camera.center);
    const Vec3d own = to_double(s.camera.corner) + x * du + y * dv;
    step_ = angle_step * std::sqrt(squared_length(own) / squared_length(du));
    for (const Vec3d& d : {own, own + step_ * du, own + step_ * dv}) rays_.push_back({center, normalized(d)});
  }

  /// The first element on the way, and its distance; -1: none.
  std::int32_t closest_element(double& t) const {
    const auto time = static_cast<double>(s_.camera.shutter_open);
    const Hit<double> hit = closest<double>(s_, {rays_[0].origin, rays_[0].direction, time, from_}, true);
    t = hit.t;
    return hit.element;
  }

  /// Reflects the path at a thing, whatever stands before it. False: it does not meet the thing.
  bool reflect(const Thing& thing) {
    const Vec3d normal = thing.is_sphere ? Vec3d{} : normalized(cross(thing.u, thing.v));
    const MetSurface m{thing.is_sphere, false, false, thing.center, thing.corner, normal, thing.radius, 0, true};
    for (Beside& beside : rays_)
      if (!follow(m, beside.origin, beside.direction)) return false;
    if (!(thing.fuzz > 0)) return true;
    const Beside own = rays_[0];
    const Basis<double> b = basis_around(own.direction);
    for (const Vec3d& across : {b.s, b.t})
      rays_.push_back({own.origin, normalized(own.direction + angle_step * across)});
    fuzz_.push_back(thing.fuzz);
    return true;
  }

  /// The same, if the thing comes first.
  bool meet(const Thing& thing) {
    double t;
    if (closest_element(t) != thing.element) return false;
    const Ray<double> ray{rays_[0].origin, rays_[0].direction, 0, from_};
    const SurfacePoint<double> p = surface_at<double>(s_, ray, t, thing.element);
    const bool inside = (dot(ray.direction, p.normal) > 0) != p.inverted;
    from_ = 4 * thing.element + (inside ? 1 : 0);
    return !(thing.is_sphere && inside) && reflect(thing);
  }

  /// The box around a light, if the path meets one next; else an empty one.
  PictureBox box() const {
    double t;
    const std::int32_t element = closest_element(t);
    if (element < 0 || s_.elements.light[element] < 0) return {};
    const LightColumns<double> light = load_light<double>(s_.lights, s_.elements.light[element]);
    const double u = light.length_u, v = light.length_v;
    const double radius = light.kind == Lights::sphere ? u : 0.5 * std::sqrt(u * u + v * v);
    const Vec3d point = rays_[0].origin + t * rays_[0].direction;
    const Matrix to_picture = inverse(changes(1, point, step_));
    double wide = radius * first_row(to_picture), high = radius * second_row(to_picture);
    for (std::size_t k = 0; k < fuzz_.size(); ++k) {
      const Matrix strays = to_picture * changes(3 + 2 * k, point, angle_step);
      wide += fuzz_[k] * first_row(strays), high += fuzz_[k] * second_row(strays);
    }
    if (!(wide < 1e6 && high < 1e6)) return {};
    PictureBox box;
    for (const int sign : {-1, 1})
      box.include({static_cast<float>(x_ + sign * wide), static_cast<float>(y_ + sign * high)});
    box.throughput = 1;
    return box;
  }

 private:
  struct Beside {
    Vec3d origin, direction;
  };

  /// How the places of two rays change, in the plane across the path at a point on it, with each step.
  Matrix changes(std::size_t k, Vec3d point, double step) const {
    return changes_of({rays_[k].origin, rays_[k + 1].origin}, {rays_[k].direction, rays_[k + 1].direction}, point,
                      rays_[0].direction, step)
        .place;
  }

  const SceneView& s_;
  double x_, y_;
  double step_;  ///< of the two rays beside it, in pixels
  std::vector<Beside> rays_;
  std::vector<double> fuzz_;
  std::int32_t from_ = from_nowhere;
};

class Finder {
 public:
  explicit Finder(const SceneView& s) : s_(s), things_(list_things(s)) {
    for (int light = 0; light < std::min(s.lights.count(), max_guide_lights); ++light)
      lights_.push_back(to_double(s.lights.center[light]));
  }

  /// What the camera sees straight.
  void add_lights() {
    for (const Vec3d& light : lights_) add_in_direction({}, light - to_double(s_.camera.center));
  }

  /// The images that the guide knows.
  void add_known() {
    const Guide& g = s_.guide;
    std::set<std::pair<std::int32_t, Events>> known;
    for (const GuideSequence& sequence : g.sequences) {
      const Events events = metal_events({sequence.next_low, sequence.next_high});
      if (sequence.image < 0 || events.empty() || !known.insert({sequence.image, events}).second) continue;
      const LightImage<float>& i = g.images[sequence.image];
      const LightImage<double> image{to_double(i.light), to_double(i.sphere), static_cast<double>(i.radius)};
      const SeenImage<double> seen = see_image(image, to_double(s_.camera.center));
      if (seen.exists) add_in_direction(events, seen.direction);
    }
  }

  std::vector<PictureBox> boxes;

 private:
  bool is_metal(const Thing& thing) const {
    return has_trait<&BsdfTraits::glossy>(s_, s_.materials.kind[s_.elements.material[thing.element]]);
  }

  /// Empty if glass is among them.
  Events metal_events(OrderedEvents<double> events) const {
    Events list;
    while (events.has_events()) {
      const std::int32_t thing = ((events.low & 63) >> 1) - 1;
      if (!is_metal(things_[static_cast<std::size_t>(thing)])) return {};
      list.push_back(thing);
      events = {events.low >> 6 | (events.high & 63) << 24, events.high >> 6};
    }
    return list;
  }

  void add_in_direction(const Events& events, Vec3d direction) {
    Pair<float> at{};
    if (project(s_.camera, to_float(direction), at)) add(events, static_cast<double>(at.x), static_cast<double>(at.y));
  }

  void add(const Events& events, double x, double y) {
    if (boxes.size() == max_boxes) return;
    CameraPath path(s_, x, y);
    for (const std::int32_t thing : events)
      if (!path.meet(things_[static_cast<std::size_t>(thing)])) return;
    const PictureBox box = path.box();
    if (!box.empty()) boxes.push_back(box);
  }

  const SceneView& s_;
  std::vector<Thing> things_;
  std::vector<Vec3d> lights_;  ///< their middles
};

}  // namespace

std::vector<PictureBox> find_camera_images(const SceneView& s) {
  if (s.guide.lobes() == 0 || s.features.lens || s.features.shutter) return {};
  Finder finder(s);
  finder.add_lights();
  finder.add_known();
  return std::move(finder.boxes);
}

}  // namespace tyndall

#include "core/guide/camera_images.h"

#include "core/compile/columns.h"
#include "core/guide/light_image.h"
#include "core/guide/nearby_rays.h"
#include "core/trace/camera.h"
#include "core/trace/intersect.h"
#include "core/trace/light_columns.h"
#include "core/trace/shade.h"

#include <set>
#include <tuple>

namespace tyndall {
namespace {

constexpr double angle_step = 1e-5;  // of rays beside the path from the camera, radian

Vec3d to_double3(Vec3f v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

/// Length of a row of a matrix.
double first_row(Matrix m) { return std::sqrt(m.a * m.a + m.b * m.b); }
double second_row(Matrix m) { return std::sqrt(m.c * m.c + m.d * m.d); }

/// A path from the camera towards the middle of a light's image, with rays beside it: two through other places of the
/// picture, and two more rotated at each fuzzy reflection.
class CameraPath {
 public:
  CameraPath(const SceneView& s, Vec3d direction, Pair<float> at) : s_(s), at_(at) {
    const CameraColumns& c = s.camera;
    const Vec3d corner = to_double3(c.corner), du = to_double3(c.du), dv = to_double3(c.dv);
    step_ = angle_step * std::sqrt(squared_length(direction) / squared_length(du));
    const Vec3d center = to_double3(c.center);
    const Vec3d middle = corner + static_cast<double>(at.x) * du + static_cast<double>(at.y) * dv;
    for (const Vec3d& d : {direction, middle + step_ * du, middle + step_ * dv})
      rays_.push_back({center, normalized(d)});
  }

  /// Follows the path to `thing`, and on. False: something else comes first.
  bool meet(const Thing& thing) {
    double t;
    if (closest_element(t) != thing.element) return false;
    const SurfacePoint<double> p = surface_at<double>(s_, ray(), t, thing.element);
    const bool exiting = dot(rays_[0].direction, p.normal) > 0, inside = exiting != p.inverted;
    const MetSurface m{thing.is_sphere, p.inverted, inside, thing.center, p.point, p.normal, thing.radius, 0, true};
    for (Beside& beside : rays_)
      if (!follow(m, beside.origin, beside.direction)) return false;
    from_ = 4 * thing.element + (inside ? 1 : 0);
    if (!(thing.fuzz > 0)) return true;
    const Beside own = rays_[0];
    const Basis<double> b = basis_around(own.direction);
    for (const Vec3d& across : {b.s, b.t})
      rays_.push_back({own.origin, normalized(own.direction + angle_step * across)});
    fuzz_.push_back(thing.fuzz);
    return true;
  }

  /// The box around the light, if the path meets one next; else an empty one.
  PictureBox box() const {
    double t;
    const std::int32_t element = closest_element(t);
    if (element < 0 || s_.light_of[element] < 0) return {};
    const LightColumns<double> light = load_light<double>(s_.lights, s_.light_of[element]);
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
    for (const float sign : {-1.0f, 1.0f})
      box.include({at_.x + sign * static_cast<float>(wide), at_.y + sign * static_cast<float>(high)});
    box.throughput = 1;
    return box;
  }

 private:
  struct Beside {
    Vec3d origin, direction;
  };

  Ray<double> ray() const {
    return {rays_[0].origin, rays_[0].direction, static_cast<double>(s_.camera.shutter_open), from_};
  }
  std::int32_t closest_element(double& t) const {
    const Hit<double> hit = closest<double>(s_, ray(), true);
    t = hit.t;
    return hit.element;
  }
  /// How the places of two rays change, in the plane across the path at a point on it, with each step.
  Matrix changes(std::size_t k, Vec3d point, double step) const {
    return changes_of({rays_[k].origin, rays_[k + 1].origin}, {rays_[k].direction, rays_[k + 1].direction}, point,
                      rays_[0].direction, step)
        .place;
  }

  const SceneView& s_;
  Pair<float> at_;
  double step_;  ///< of the two rays beside it, in pixels
  std::vector<Beside> rays_;
  std::vector<double> fuzz_;
  std::int32_t from_ = from_nowhere;
};

/// Adds the box of the image in a direction from the camera, by way of events of which the first is in the lowest bits.
void add_image(const SceneView& s, const std::vector<Thing>& things, Vec3d direction, OrderedEvents<double> events,
               std::vector<PictureBox>& boxes) {
  Pair<float> at{};
  const Vec3f narrow = to_float(direction);
  if (!project(s.camera, narrow, at)) return;
  CameraPath path(s, direction, at);
  for (; events.has_events() || events.high > 0;
       events = {events.low >> 6 | (events.high & 63) << 24, events.high >> 6}) {
    const Thing& thing = things[static_cast<std::size_t>(((events.low & 63) >> 1) - 1)];
    const std::int32_t kind = s.kind[s.material[thing.element]];
    if ((events.low & 1) == 0 || !has_trait<&BsdfTraits::glossy>(s, kind) || !path.meet(thing)) return;
  }
  const PictureBox box = path.box();
  if (!box.empty()) boxes.push_back(box);
}

}  // namespace

std::vector<PictureBox> find_camera_images(const SceneView& s) {
  const GuideView& g = s.guide;
  std::vector<PictureBox> boxes;
  if (g.lobes == 0) return boxes;
  const std::vector<Thing> things = list_things(s);
  const Vec3d camera = to_double3(s.camera.center);
  for (int light = 0; light < std::min(s.lights.count, max_guide_lights); ++light) {
    const auto at = [&](int axis) { return static_cast<double>(s.lights.center[axis][light]); };
    add_image(s, things, Vec3d{at(0), at(1), at(2)} - camera, OrderedEvents<double>::none(), boxes);
  }
  std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> known;
  for (int i = 0; i < g.lobes; ++i) {
    const std::int32_t* e = g.events + i * numbers_of_events;
    if (e[events_image] < 0 || !known.insert({e[events_image], e[events_next_low], e[events_next_high]}).second)
      continue;
    const float* n = g.images + e[events_image] * numbers_of_image;
    const auto place = [&](int k) { return to_double3({n[k], n[k + 1], n[k + 2]}); };
    const LightImage<double> image{place(image_light), place(image_sphere), static_cast<double>(n[image_radius])};
    const SeenImage<double> seen = see_image(image, camera);
    if (seen.exists) add_image(s, things, seen.direction, {e[events_next_low], e[events_next_high]}, boxes);
  }
  return boxes;
}

}  // namespace tyndall

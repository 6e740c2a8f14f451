#include "core/compile/columns.h"
#include "core/guide/find_guide.h"
#include "core/guide/things.h"
#include "core/trace/camera.h"
#include "core/trace/intersect.h"
#include "core/trace/light_choice.h"
#include "core/trace/shade.h"

#include <array>
#include <set>

namespace tyndall {
namespace {

constexpr std::size_t max_boxes = 64;  // because all samples of a row of tiles look at all boxes there

/// Length of a row of a matrix.
double first_row(Matrix m) { return std::sqrt(m.a * m.a + m.b * m.b); }
double second_row(Matrix m) { return std::sqrt(m.c * m.c + m.d * m.d); }

/// A path from the camera through the place (x, y) of the picture, and two through places beside it, `step` pixels
/// away.
Beam camera_beam(const SceneView& s, double x, double y, double& step) {
  const Vec3d du = to_double(s.camera.du), dv = to_double(s.camera.dv), center = to_double(s.camera.center);
  const Vec3d own = to_double(s.camera.corner) + x * du + y * dv;
  step = angle_step * std::sqrt(dot(own, own) / dot(du, du));
  Beam beam;
  beam.time = static_cast<double>(s.camera.shutter_open);
  for (const Vec3d& d : {own, own + step * du, own + step * dv}) beam.rays.push_back({center, normalize(d)});
  return beam;
}

/// Sends a beam on by a reflection at a thing. False: it does not meet this first, or not as a mirror does.
bool reflect_at(const SceneView& s, const Thing& thing, Beam& beam) {
  const Ray<double> ray = beam.path();
  const Hit<double> hit = closest<double>(s, ray, true);
  if (hit.element != thing.element ||
      !has_trait<&BsdfTraits::glossy>(s, s.materials.kind[s.elements.material[hit.element]]))
    return false;
  const SurfacePoint<double> p = surface_at<double>(s, ray, hit.t, hit.element);
  const bool inside = (dot(ray.direction, p.normal) > 0) != p.inverted;
  if (thing.is_sphere && inside) return false;
  beam.from = 4 * thing.element + (inside ? 1 : 0);
  const Vec3d normal = thing.is_sphere ? Vec3d{} : normalize(cross(thing.u, thing.v));
  return beam.pass({thing.is_sphere, false, false, thing.center, thing.corner, normal, thing.radius, 0, true},
                   thing.fuzz);
}

/// The box around a light that the camera sees at the place (x, y) after `events`, the next of which is in the lowest
/// bits; else an empty one.
PictureBox box_at(const SceneView& s, const std::vector<Thing>& things, OrderedEvents<double> events, double x,
                  double y) {
  double step;
  Beam beam = camera_beam(s, x, y, step);
  for (; events.has_events(); events = events.without_lowest())
    if (!reflect_at(s, things[static_cast<std::size_t>(events.lowest_thing())], beam)) return {};
  const Ray<double> ray = beam.path();
  const Hit<double> hit = closest<double>(s, ray, true);
  if (hit.element < 0 || s.elements.light[hit.element] < 0 || !beam.is_whole()) return {};
  const LightColumns<double> light = load_light<double>(s.lights, s.elements.light[hit.element]);
  const double u = light.length_u, v = light.length_v;
  const double radius = light.kind == Lights::sphere ? u : 0.5 * std::sqrt(u * u + v * v);
  const Vec3d point = ray.origin + hit.t * ray.direction;
  const Matrix to_picture = inverse(beam.changes(1, point, step).place);
  double wide = radius * first_row(to_picture), high = radius * second_row(to_picture);
  for (std::size_t k = 0; k < beam.fuzz.size(); ++k) {
    const Matrix strays = to_picture * beam.changes(3 + 2 * k, point, angle_step).place;
    wide += beam.fuzz[k] * first_row(strays), high += beam.fuzz[k] * second_row(strays);
  }
  if (!(wide < 1e6 && high < 1e6)) return {};
  PictureBox box;
  for (const int sign : {-1, 1})
    box.include({static_cast<float>(x + sign * wide), static_cast<float>(y + sign * high)});
  box.throughput = 1;
  return box;
}

}  // namespace

std::vector<PictureBox> find_camera_images(const SceneView& s) {
  if (s.guide.lobes() == 0 || s.features.lens || s.features.shutter) return {};
  const std::vector<Thing> things = list_things(s);
  const Vec3d center = to_double(s.camera.center);
  std::vector<PictureBox> boxes;
  const auto add = [&](const OrderedEvents<double>& events, Vec3d direction) {
    Pair<float> place{};
    if (boxes.size() == max_boxes || !project(s.camera, to_float(direction), place)) return;
    const PictureBox box = box_at(s, things, events, static_cast<double>(place.x), static_cast<double>(place.y));
    if (!box.empty()) boxes.push_back(box);
  };
  for (int light = 0; light < std::min(s.lights.count(), max_guide_lights); ++light)
    add(OrderedEvents<double>::none(), to_double(s.lights.center[light]) - center);
  std::set<std::array<std::int32_t, 3>> known;
  for (const GuideSequence& sequence : s.guide.sequences) {
    if (sequence.image < 0 || !known.insert({sequence.image, sequence.next_low, sequence.next_high}).second) continue;
    const LightImage<float>& i = s.guide.images[sequence.image];
    const SeenImage<double> seen =
        see_image<double>({to_double(i.light), to_double(i.sphere), static_cast<double>(i.radius)}, center);
    if (seen.exists) add({sequence.next_low, sequence.next_high}, seen.direction);
  }
  return boxes;
}

}  // namespace tyndall

#include "core/scene/frames.h"

#include "core/base/elementary.h"
#include "core/base/text.h"
#include "core/scene/check.h"
#include "core/scene/json_read.h"
#include "core/scene/slots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace tyndall {
namespace {

Vec3d vector_of(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// A vector in spherical coordinates about an axis: its length, the angle around the axis, and that from the axis.
struct Spherical {
  double length = 0, around = 0, from_axis = 0;
};

/// Two directions that are at right angles to the axis and to each other.
struct AxisFrame {
  Vec3d axis, a, b;
  explicit AxisFrame(Vec3d up) : axis(normalize(up)) {
    const Vec3d other = std::abs(axis.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
    a = normalize(cross(axis, other));
    b = cross(axis, a);
  }
  Spherical spherical(Vec3d v) const {
    const double height = dot(v, axis), size = length(v);
    const double x = dot(v, a), y = dot(v, b);
    return {size, x == 0 && y == 0 ? 0 : arc_tangent(y, x), arc_tangent(length(Vec3d{x, y, 0}), height)};
  }
  Vec3d vector(const Spherical& s) const {
    const double flat = s.length * sine(s.from_axis);
    return flat * cosine(s.around) * a + flat * sine(s.around) * b + s.length * cosine(s.from_axis) * axis;
  }
};

Vec3d look_at(const Scene& scene, double time) {
  const KeyedValue* target = find_keys(*scene.animation, "/camera/look_at");
  return target ? vector_of(value_at(*target, scene.animation->curve, time)) : scene.camera.look_at;
}

bool is_at_key(const KeyedValue& keyed, double time) {
  return std::any_of(keyed.keys.begin(), keyed.keys.end(), [&](const KeyFrame& key) { return key.frame == time; });
}

/// The keys of look_from as spherical coordinates around look_at, which may have keys of its own. From key to key the
/// camera goes around the shorter way.
KeyedValue spherical_keys(const KeyedValue& keyed, const Scene& scene, const AxisFrame& frame) {
  KeyedValue out = keyed;
  double before = 0;
  for (KeyFrame& key : out.keys) {
    Spherical s = frame.spherical(vector_of(key.value) - look_at(scene, key.frame));
    if (&key != out.keys.data()) s.around = before + std::remainder(s.around - before, 2 * std::numbers::pi);
    before = s.around;
    key.value = {s.length, s.around, s.from_axis};
  }
  return out;
}

std::vector<double> keyed_value(const KeyedValue& keyed, const Scene& scene, double time) {
  const Animation& animation = *scene.animation;
  if (!animation.orbit || keyed.pointer != "/camera/look_from" || keyed.keys[0].value.size() != 3 ||
      is_at_key(keyed, time))
    return value_at(keyed, animation.curve, time);
  const AxisFrame frame(scene.camera.vup);
  const std::vector<double> s = value_at(spherical_keys(keyed, scene, frame), animation.curve, time);
  const Vec3d place = look_at(scene, time) + frame.vector({s[0], s[1], s[2]});
  return {place.x, place.y, place.z};
}

JsonValue json_of(const std::vector<double>& value, bool whole) {
  if (value.size() != 1) return to_json(value);
  return {whole ? std::round(value[0]) : value[0]};  // all numbers of /render are whole
}

void apply_key(JsonValue& root, const KeyedValue& keyed, const Scene& scene, double time) {
  const auto steps = pointer_steps(keyed.pointer);
  const std::vector<double> value = keyed_value(keyed, scene, time);
  put_value(root, *steps, json_of(value, steps->front() == "render"), keyed.pointer);
}

/// Lets spheres at rest whose center has keys move within the frame.
void blur_motion(Scene& still, const Scene& scene, double time) {
  for (const KeyedValue& keyed : scene.animation->keyed) {
    std::vector<std::string> steps = *pointer_steps(keyed.pointer);
    Object* object = object_at(still, steps);
    auto* solid = object && steps == std::vector<std::string>{"center"} ? std::get_if<Solid3d>(&object->kind) : nullptr;
    auto* sphere = solid ? std::get_if<Sphere<>>(&solid->shape) : nullptr;
    const std::vector<double> next = keyed_value(keyed, scene, time + 1);
    if (sphere && !sphere->center_end && next != keyed_value(keyed, scene, time)) sphere->center_end = vector_of(next);
  }
}

}  // namespace

Scene scene_at(const Scene& scene, double time) {
  Scene still = scene;
  still.animation.reset();
  if (!scene.animation || scene.animation->keyed.empty()) return still;
  JsonValue root = scene_json(still);
  add_sections(root);
  for (const KeyedValue& keyed : scene.animation->keyed) apply_key(root, keyed, scene, time);
  still = scene_with_pictures(root, scene);
  if (still.camera.shutter_close != 0 || still.camera.shutter_open != 0) blur_motion(still, scene, time);
  return checked(std::move(still));
}

Scene frame_scene(const Scene& scene, const FramePlan& plan, int frame) {
  Scene made = scene_at(scene, frame);
  if (plan.turntable) {
    Camera& camera = made.camera;
    const AxisFrame about(camera.vup);
    Spherical place = about.spherical(camera.look_from - camera.look_at);
    place.around += 2 * std::numbers::pi * frame / plan.frames;
    if (frame != 0) camera.look_from = camera.look_at + about.vector(place);
  }
  if (plan.seed_per_frame) {
    constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
    const auto n = static_cast<std::uint32_t>(frame);
    if (made.render.seed > last - n)
      throw ParseError{"/render/seed", std::to_string(made.render.seed),
                       "at most " + std::to_string(last - n) + ", as the seed of frame " + std::to_string(frame) +
                           " is that of the scene and " + std::to_string(frame)};
    made.render.seed += n;
  }
  return checked(std::move(made));
}

void drop_lost_keys(Scene& scene) {
  if (!scene.animation) return;
  std::erase_if(scene.animation->keyed,
                [&](const KeyedValue& keyed) { return !value_at_pointer(scene, keyed.pointer); });
}

void check_keys(const Scene& scene) {
  if (!scene.animation) return;
  std::set<int> frames;
  for (const KeyedValue& keyed : scene.animation->keyed)
    for (const KeyFrame& key : keyed.keys) frames.insert(key.frame);
  for (const int frame : frames) {
    try {
      scene_at(scene, frame);
    } catch (const ParseError& error) {
      for (const KeyedValue& keyed : scene.animation->keyed) {
        if (is_at_key(keyed, frame) && error.where.starts_with(keyed.pointer))
          throw ParseError{"/animation/keys/" + pointer_step(keyed.pointer) + "/" + std::to_string(frame), error.found,
                           error.expected};
      }
      throw ParseError{"/animation/keys, frame " + std::to_string(frame) + ": " + error.where, error.found,
                       error.expected};
    }
  }
}

}  // namespace tyndall

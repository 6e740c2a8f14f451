#include "core/scene/frames.h"

#include "core/base/elementary.h"
#include "core/base/text.h"
#include "core/scene/check.h"
#include "core/scene/json_read.h"
#include "core/scene/slots.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace tyndall {
namespace {

/// Whether both cameras see the same. A camera without a lens has everything in focus, wherever it is focused.
bool same_view(const Camera& a, Camera b) {
  if (a.defocus_angle == 0 && b.defocus_angle == 0) b.focus_distance = a.focus_distance;
  return a == b;
}

/// Slope of component c between key k and the next one.
double secant(const std::vector<KeyFrame>& keys, std::size_t k, std::size_t c) {
  return (keys[k + 1].value[c] - keys[k].value[c]) / (keys[k + 1].frame - keys[k].frame);
}

/// Slope of component c at key k: see value_at().
double slope_at(const std::vector<KeyFrame>& keys, std::size_t k, std::size_t c) {
  if (k == 0 || k + 1 == keys.size()) return 0;
  const double before = secant(keys, k - 1, c), after = secant(keys, k, c);
  if (!(before * after > 0)) return 0;
  const double h0 = keys[k].frame - keys[k - 1].frame, h1 = keys[k + 1].frame - keys[k].frame;
  const double w0 = h0 + 2 * h1, w1 = 2 * h0 + h1;
  return (w0 + w1) / (w0 / before + w1 / after);
}

double hermite(double t, double h, double from, double to, double slope_from, double slope_to) {
  const double s = 1 - t;
  const double value =
      s * s * (1 + 2 * t) * from + t * t * (3 - 2 * t) * to + h * t * s * (s * slope_from - t * slope_to);
  return std::clamp(value, std::min(from, to), std::max(from, to));  // rounding alone
}

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

void apply_key(JsonValue& root, const KeyedValue& keyed, const Scene& scene, double time) {
  const auto steps = pointer_steps(keyed.pointer);
  const std::vector<double> value = keyed_value(keyed, scene, time);
  const bool whole = steps->front() == "render";  // as all its numbers
  const JsonValue number{whole ? std::round(value[0]) : value[0]};
  put_value(root, *steps, value.size() == 1 ? number : to_json(value), keyed.pointer);
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

SceneChange change_between(const Scene& before, const Scene& after) {
  // By name and one by one, because a copy of a large scene costs more than the comparison. A member that is added to
  // Scene does not compile here until it was decided whether samples depend on it.
  const auto& [name_a, width_a, height_a, camera_a, background_a, render_a, display_a, animation_a, textures_a,
               materials_a, objects_a] = before;
  const auto& [name_b, width_b, height_b, camera_b, background_b, render_b, display_b, animation_b, textures_b,
               materials_b, objects_b] = after;
  RenderSettings render = render_b;
  render.spp = render_a.spp;
  const bool same_things =
      background_a == background_b && textures_a == textures_b && materials_a == materials_b && objects_a == objects_b;
  const bool same = width_a == width_b && height_a == height_b && render_a == render && same_things;
  render.seed = render_a.seed, render.sampler = render_a.sampler;
  const bool same_light = same_things && render_a == render && camera_a.shutter_open == camera_b.shutter_open &&
                          camera_a.shutter_close == camera_b.shutter_close;
  return {!same_view(camera_a, camera_b), !same, !same_light};
}

std::vector<double> value_at(const KeyedValue& keyed, Curve curve, double time) {
  const std::vector<KeyFrame>& keys = keyed.keys;
  assert(!keys.empty());
  if (time <= keys.front().frame) return keys.front().value;
  if (time >= keys.back().frame) return keys.back().value;
  std::size_t k = 0;
  while (keys[k + 1].frame <= time) ++k;
  const double h = keys[k + 1].frame - keys[k].frame, t = (time - keys[k].frame) / h;
  std::vector<double> value = keys[k].value;
  if (t == 0) return value;
  for (std::size_t c = 0; c < value.size(); ++c) {
    const double from = keys[k].value[c], to = keys[k + 1].value[c];
    value[c] = curve == Curve::linear ? (1 - t) * from + t * to
                                      : hermite(t, h, from, to, slope_at(keys, k, c), slope_at(keys, k + 1, c));
  }
  return value;
}

void set_key(Animation& animation, const std::string& pointer, KeyFrame key) {
  const auto is_it = [&](const KeyedValue& keyed) { return keyed.pointer == pointer; };
  auto at = std::find_if(animation.keyed.begin(), animation.keyed.end(), is_it);
  if (at == animation.keyed.end()) at = animation.keyed.insert(at, {pointer, {}});
  const auto before = [](const KeyFrame& a, const KeyFrame& b) { return a.frame < b.frame; };
  const auto place = std::lower_bound(at->keys.begin(), at->keys.end(), key, before);
  if (place != at->keys.end() && place->frame == key.frame)
    *place = std::move(key);
  else
    at->keys.insert(place, std::move(key));
}

const KeyedValue* find_keys(const Animation& animation, const std::string& pointer) {
  for (const KeyedValue& keyed : animation.keyed)
    if (keyed.pointer == pointer) return &keyed;
  return nullptr;
}

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
      const std::vector<KeyedValue>& keyed = scene.animation->keyed;
      const auto at_fault = std::find_if(keyed.begin(), keyed.end(), [&](const KeyedValue& one) {
        return is_at_key(one, frame) && error.where.starts_with(one.pointer);
      });
      const std::string key = at_fault == keyed.end()
                                  ? ", frame " + std::to_string(frame) + ": " + error.where
                                  : "/" + pointer_step(at_fault->pointer) + "/" + std::to_string(frame);
      throw ParseError{"/animation/keys" + key, error.found, error.expected};
    }
  }
}

}  // namespace tyndall

#include "core/scene/scene.h"

#include <algorithm>
#include <cassert>

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

}  // namespace tyndall

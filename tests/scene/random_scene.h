#pragma once
#include "core/scene/check.h"
#include "core/scene/slots.h"
#include "tests/scene/everything.h"
#include "tests/scene/files.h"

#include <cmath>
#include <random>

/// Valid scenes that use every value of the format, by the same lists as reading and writing.
namespace tyndall::test {

inline void add_parts(const std::vector<Object>& objects, const std::string& before, std::vector<std::string>& parts) {
  const auto add_steps = [&](const std::string& owner, const Transform& transform) {
    for (std::size_t k = 0; k < transform.size(); ++k) parts.push_back(owner + "/transform/" + std::to_string(k));
  };
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const std::string part = before + "/objects/" + std::to_string(k);
    parts.push_back(part);
    add_steps(part, objects[k].transform);
    if (const Volume* volume = std::get_if<Volume>(&objects[k].kind)) {
      parts.push_back(part + "/boundary");
      add_steps(part + "/boundary", volume->boundary_transform);
    }
    if (const Group* group = std::get_if<Group>(&objects[k].kind)) add_parts(group->objects, part, parts);
  }
}

/// All parts of a scene.
inline std::vector<std::string> parts_of(const Scene& scene) {
  std::vector<std::string> parts{"", "/camera", "/render", "/display", "/image", "/animation", "/background"};
  for (const Material& material : scene.materials) parts.push_back("/materials/" + pointer_step(material.name));
  for (const Texture& texture : scene.textures) parts.push_back("/textures/" + pointer_step(texture.name));
  add_parts(scene.objects, "", parts);
  return parts;
}

/// Random values, and names.
class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool chance() { return below(2) == 0; }

  /// A number of any magnitude and number of digits within the range.
  double number(const Valid& valid) {
    while (true) {
      const double unit = std::uniform_real_distribution(-1.0, 1.0)(random_);
      double v = unit * std::pow(10.0, below(13) - 6);
      if (std::isfinite(valid.low) && std::isfinite(valid.high))
        v = valid.low + (valid.high - valid.low) * std::abs(unit);
      if (below(4) == 0) v = std::round(v);
      if (valid.contains(v) && valid.contains(static_cast<double>(static_cast<float>(v)))) return v;
    }
  }

  Value value(const Slot& slot) {
    if (!slot.choices.empty()) return static_cast<double>(below(static_cast<int>(slot.choices.size())));
    if (slot.form == ValueForm::whole) return std::max(slot.valid.low, 0.0) + below(5000);
    if (slot.form == ValueForm::number) return number(slot.valid);
    return Vec3d{number(slot.valid), number(slot.valid), number(slot.valid)};
  }

  /// A text with letters that JSON, pointers and terminals treat specially.
  std::string name() {
    constexpr const char* letters[] = {"a",  "B",    "7", " ",  "/",    "~", "\"", "\\",
                                       "\n", "\x01", "ä", "世", "🙂", "'", "{",  "//"};
    std::string out;
    for (int i = below(8); i > 0; --i) out += letters[below(16)];
    return out;
  }

 private:
  std::mt19937 random_;
};

/// Some of the things of a scene that has all kinds, by other names, with random values as far as they fit each other.
inline Scene random_scene(unsigned seed) {
  RandomValues random(seed);
  static const Scene all = parsed(everything);
  Scene scene = all;
  std::erase_if(scene.objects, [&](const Object&) { return random.chance(); });
  scene.name = random.name();
  for (Object& object : scene.objects) object.name = random.chance() ? random.name() : "";
  for (Material& material : scene.materials) material.name = random.name() + material.name;
  for (Texture& texture : scene.textures) texture.name = random.name() + texture.name;
  scene.textures.back().kind = Solid<>();  // in place of a picture, which takes long to read
  if (random.chance()) scene.background = Gradient{};
  if (random.chance()) scene.background = Vec3d{1, 2, 3};
  if (random.chance()) scene.camera.focus_distance.reset();
  scene.camera.shutter_open = random.number(any_number());
  scene.camera.shutter_close = scene.camera.shutter_open + (random.chance() ? 0 : random.number(at_least(0)));
  for (const std::string& part : parts_of(scene))
    for (const Slot& slot : slots_of(scene, part)) {
      const Scene before = scene;
      if (random.below(4) == 0) continue;
      put_value(scene, slot.pointer, random.value(slot));
      if (check(scene)) scene = before;
    }
  return scene;
}

}  // namespace tyndall::test

#include "core/scene/slots.h"

#include <cctype>
#include <string_view>

namespace tyndall {

std::string label_of(const char* name, const char* label) {
  std::string text = *label ? label : name;
  std::replace(text.begin(), text.end(), '_', ' ');
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

Slot colour_slot(std::string pointer, const char* name, Vec3d value) {
  const bool background = std::string_view(name) == "colour", shines = std::string_view(name) == "radiance";
  const Meaning meaning = colour_meaning(background ? "radiance" : name);
  const char* synonyms = background ? "background color, background colour, sky color, sky colour"
                         : shines   ? "light texture, emission texture"
                                    : "color, colour, base color, base colour, diffuse, tint, reflectance, texture";
  Slot slot{std::move(pointer), label_of(name, ""), name,           synonyms,         "",
            meaning.help,       meaning.valid,      meaning.slider, ValueForm::colour};
  if (background) slot.slider.high = 2;
  slot.value = value;
  slot.standard = background ? Vec3d{} : Vec3d{0.5, 0.5, 0.5};
  return slot;
}

std::vector<Slot> slots_of(const Scene& scene, const std::string& part) {
  std::vector<Slot> slots;
  visit_part(scene, part, [&](const Slot& slot, const auto&) {
    slots.push_back(slot);
    return false;
  });
  return slots;
}

std::optional<Slot> find_slot(const Scene& scene, const std::string& pointer) {
  for (Slot& slot : slots_of(scene, part_of(pointer)))
    if (slot.pointer == pointer) return std::move(slot);
  return {};
}

bool put_value(Scene& scene, const std::string& pointer, const Value& value) {
  bool found = false;
  visit_part(scene, part_of(pointer), [&](Slot& slot, const auto&) {
    if (slot.pointer != pointer) return false;
    slot.value = value;
    return found = true;
  });
  return found;
}

}  // namespace tyndall

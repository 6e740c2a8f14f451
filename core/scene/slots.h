#pragma once
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

/// The values of a scene by their JSON pointers, with all that fields() says of them. One walk lists, describes, reads
/// and writes them, without a JSON tree in between. A part is a pointer without its last step: "/materials/gold".
namespace tyndall {

/// Of switches and choices the number.
using Value = std::variant<double, Vec3d>;

/// What kind of control a value needs. Places are vectors without a slider, colours those with one.
enum class ValueForm { number, whole, flag, choice, place, colour };

/// What is known of a value, whatever it is of.
struct Slot {
  std::string pointer, label;
  const char *name, *synonyms;  ///< its key in files; what other programs call it, separated by ", "
  const char *unit, *help;
  Valid valid;
  Slider slider;
  ValueForm form = ValueForm::number;
  std::vector<Label> choices{};  ///< also of switches
  Value value{}, standard{};     ///< now, and where a scene says nothing
  bool given = true;             ///< false: the scene leaves it open
};

/// "Refractive index": what a field is called on screen.
std::string label_of(const char* name, const char* label);

/// The slot of a colour's Vec3d: a material's, a medium's or the background's.
Slot colour_slot(std::string pointer, const char* name, Vec3d value);

/// A member as a value; what is not given counts as 0.
inline Value to_value(const Vec3d& member) { return member; }
Value to_value(const auto& member) { return static_cast<double>(member); }
template <class T>
Value to_value(const std::optional<T>& member) {
  return to_value(member.value_or(T{}));
}

/// And back. A whole number that may be left open is so at 0.
inline void from_value(const Value& value, Vec3d& member) { member = std::get<Vec3d>(value); }
template <class T>
void from_value(const Value& value, T& member) {
  member = static_cast<T>(std::get<double>(value));
}
template <class T>
void from_value(const Value& value, std::optional<T>& member) {
  from_value(value, member.emplace());
  if (std::is_same_v<T, int> && !(std::get<double>(value) > 0)) member.reset();
}

/// The type of a member, also of one that may be left open.
template <class T>
T given_type(const T&);
template <class T>
T given_type(const std::optional<T>&);

template <class Owner, class T>
Slot slot_of(const std::string& part, const Field<Owner, T>& field, const T& now, const T& standard) {
  using P = decltype(given_type(now));
  Slot slot{part + "/" + field.name,
            label_of(field.name, field.label),
            field.name,
            field.words,
            field.unit,
            field.help,
            field.valid,
            field.slider};
  slot.value = to_value(now), slot.standard = to_value(standard);
  if constexpr (NamedEnum<P>) {
    slot.form = ValueForm::choice;
    for (int k = 0; k < count_of<P>(); ++k) slot.choices.push_back(label(static_cast<P>(k)));
  } else if constexpr (std::is_same_v<P, bool>) {
    slot.form = ValueForm::flag;
    slot.choices = {{"off"}, {"on"}};
  } else if constexpr (std::is_same_v<P, Vec3d>) {
    slot.form = has_slider(field.slider) ? ValueForm::colour : ValueForm::place;
  } else if constexpr (std::is_integral_v<P>) {
    slot.form = ValueForm::whole;
    slot.valid.high = std::min(slot.valid.high, static_cast<double>(std::numeric_limits<P>::max()));
  }
  if constexpr (std::is_same_v<T, std::optional<int>>)
    slot.valid.low = 0;
  else if constexpr (!std::is_same_v<T, P>)
    slot.given = now.has_value();
  return slot;
}

/// Calls use(slot, owner) for each value in a list of fields. What it returns true for is set to slot.value.
template <class Owner, class Fields, class Use>
void each_in(const std::string& part, Owner& owner, const Fields& list, const Use& use) {
  [[maybe_unused]] static const std::remove_const_t<Owner> standard{};
  for_each_field(list, [&](const auto& field) {
    auto& member = owner.*(field.value);
    Slot slot = slot_of(part, field, member, standard.*(field.value));
    [[maybe_unused]] const bool put = use(slot, std::as_const(owner));
    if constexpr (!std::is_const_v<Owner>)
      if (put) from_value(slot.value, member);
  });
}
template <class Owner, class Use>
void each_in(const std::string& part, Owner& owner, const Use& use) {
  each_in(part, owner, fields_of<std::remove_const_t<Owner>>(), use);
}

/// The same for a colour, unless a texture gives it.
template <class Owner, class Colour, class Use>
void colour_in(const std::string& pointer, const char* name, Owner& owner, Colour& colour, const Use& use) {
  auto* rgb = std::get_if<Vec3d>(&colour);
  if (!rgb) return;
  Slot slot = colour_slot(pointer, name, *rgb);
  [[maybe_unused]] const bool put = use(slot, std::as_const(owner));
  if constexpr (!std::is_const_v<Colour>)
    if (put) *rgb = std::get<Vec3d>(slot.value);
}

/// The object whose pointer the steps begin with; null: there is none. Its steps are taken off.
template <class SceneT>
auto* object_at(SceneT& scene, std::vector<std::string>& steps) {
  auto* list = &scene.objects;
  decltype(list->data()) found = nullptr;
  std::size_t k = 0;
  for (; list && k + 1 < steps.size() && steps[k] == "objects"; k += 2) {
    const std::size_t index = std::strtoul(steps[k + 1].c_str(), nullptr, 10);
    found = index < list->size() ? &(*list)[index] : nullptr;
    auto* group = found ? std::get_if<Group>(&found->kind) : nullptr;
    list = group ? &group->objects : nullptr;
  }
  steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k));
  return found;
}

/// The values of an object's part. rest: its steps within the object.
template <class ObjectT, class Use>
void visit_object(ObjectT& object, const std::string& part, std::vector<std::string> rest, const Use& use) {
  auto* volume = std::get_if<Volume>(&object.kind);
  auto* solid = std::get_if<Solid3d>(&object.kind);
  const bool boundary = volume && !rest.empty() && rest[0] == "boundary";
  if (boundary) rest.erase(rest.begin());
  if (rest.size() == 2 && rest[0] == "transform") {
    auto& moves = boundary ? volume->boundary_transform : object.transform;
    const std::size_t k = std::strtoul(rest[1].c_str(), nullptr, 10);
    if (k < moves.size()) std::visit([&](auto& move) { each_in(part, move, use); }, moves[k]);
  } else if (boundary) {
    std::visit([&](auto& shape) { each_in(part, shape, use); }, volume->boundary);
  } else if (volume) {
    each_in(part, volume->medium, use);
    colour_in(part + "/albedo", "albedo", volume->medium, volume->albedo, use);
  } else if (solid) {
    std::visit([&](auto& shape) { each_in(part, shape, use); }, solid->shape);
  }
}

/// Calls use(slot, owner) for each value of a part, in the order of its fields. Where the scene is not const, a value
/// for which it returns true is set to slot.value.
template <class SceneT, class Use>
void visit_part(SceneT& scene, const std::string& part, const Use& use) {
  if (part.empty()) return colour_in("/background", "colour", scene, scene.background, use);
  std::vector<std::string> steps = pointer_steps(part).value_or(std::vector<std::string>{""});
  const std::string head = steps[0], name = steps.size() == 2 ? steps[1] : "";
  if (part == "/camera") return each_in(part, scene.camera, use);
  if (part == "/render") return each_in(part, scene.render, use);
  if (part == "/display") return each_in(part, scene.display, use);
  if (part == "/image") return each_in(part, scene, image_fields(), use);
  if (part == "/animation" && scene.animation) return each_in(part, *scene.animation, use);
  const auto visit = [&](auto& kind) {
    if constexpr (requires { fields(&kind); }) each_in(part, kind, use);
  };
  if (part == "/background") return std::visit(visit, scene.background);
  const auto is_named = [&](const auto& one) { return one.name == name; };
  const auto texture = std::find_if(scene.textures.begin(), scene.textures.end(), is_named);
  if (head == "textures" && texture != scene.textures.end()) return std::visit(visit, texture->kind);
  const auto material = std::find_if(scene.materials.begin(), scene.materials.end(), is_named);
  if (head == "materials" && material != scene.materials.end()) {
    std::visit(visit, material->kind);
    const char* colour = colour_name(material->kind);
    return colour ? colour_in(part + "/" + colour, colour, *material, material->colour, use) : void();
  }
  if (auto* object = object_at(scene, steps)) visit_object(*object, part, steps, use);
}

/// The part that a value is in.
inline std::string part_of(const std::string& pointer) { return pointer.substr(0, pointer.rfind('/')); }

/// The values of a part, in the order of its fields.
std::vector<Slot> slots_of(const Scene& scene, const std::string& part);
/// The value there; nothing: the scene has none.
std::optional<Slot> find_slot(const Scene& scene, const std::string& pointer);
/// Sets it; it must be valid. Returns whether there is one.
bool put_value(Scene& scene, const std::string& pointer, const Value& value);

}  // namespace tyndall

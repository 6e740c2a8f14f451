#include "app/window/panels/rows.h"

#include "app/window/panels/meaning.h"
#include "app/window/tools/camera_control.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

/// A row's name in the log: its key; of the steps of a transform, which may have the same, "transform0" or "boundary0".
std::string name_of(const Slot& slot) {
  const std::string step = "/transform/", owner = "/boundary";
  const std::size_t at = slot.pointer.rfind(step);
  if (at == std::string::npos) return slot.name;
  const bool of_boundary = at >= owner.size() && slot.pointer.compare(at - owner.size(), owner.size(), owner) == 0;
  const std::string rest = slot.pointer.substr(at + step.size());
  return (of_boundary ? "boundary" : "transform") + rest.substr(0, rest.find('/'));
}

template <class Owner>
std::string meaning_of(const Owner& owner, const Slot& slot) {
  if constexpr (std::is_same_v<Owner, Material>) return colour_meaning(owner, std::get<Vec3d>(slot.value));
  if constexpr (std::is_same_v<Owner, Medium<>>)
    if (slot.form == ValueForm::colour) return albedo_meaning(owner, std::get<Vec3d>(slot.value));
  if constexpr (requires { meaning(owner, slot.name); })
    return meaning(owner, slot.name);
  else
    return "";
}

/// The distance in focus is shown also where the scene leaves it open.
void fill_in(const Camera& camera, Slot& slot) {
  if (!slot.given && slot.name == std::string_view("focus_distance"))
    slot.value = focus_distance(camera), slot.given = true;
}

/// Whether the same object stands in the file where a pointer leads to; also where it leads to none.
bool is_same_object(const Scene& now, const Scene& saved, const std::string& pointer) {
  std::vector<std::string> steps = pointer_steps(pointer).value_or(std::vector<std::string>{}), again = steps;
  const Object *object = object_at(now, steps), *other = object_at(saved, again);
  return !object || (other && other->name == object->name && other->kind.index() == object->kind.index());
}

std::vector<Slot> saved_slots(const PanelState& state, const std::string& part) {
  if (!is_same_object(*state.scene, state.now.origin->saved, part + "/")) return {};
  std::vector<Slot> slots = slots_of(state.now.origin->saved, part);
  for (Slot& slot : slots) fill_in(state.now.origin->saved.camera, slot);
  return slots;
}

/// What a double click sets; nothing for choices.
std::optional<Vec3d> original_of(const std::vector<Slot>& saved, const Slot& slot) {
  if (slot.form == ValueForm::choice || slot.form == ValueForm::flag) return {};
  const auto found = std::find_if(saved.begin(), saved.end(), [&](const Slot& one) {
    return one.given && one.pointer == slot.pointer && one.form == slot.form;
  });
  const Value& value = found == saved.end() ? slot.standard : found->value;
  const double* number = std::get_if<double>(&value);
  return number ? Vec3d{*number, 0, 0} : std::get<Vec3d>(value);
}

bool choose(Ui& ui, const Slot& slot, Row row, double& value) {
  std::vector<Choice> choices;
  for (const Label& one : slot.choices) choices.push_back({one.name, nullptr, one.help});
  int chosen = static_cast<int>(value);
  const Label& now = slot.choices[static_cast<std::size_t>(chosen)];
  row.warning = now.approximation;
  if (row.warning) row.meaning = std::string("approximation: ") + now.help;
  if (!choice_row(ui, row, choices, chosen)) return false;
  value = chosen;
  return true;
}

}  // namespace

Row row_of(const Slot& slot, std::string meaning) {
  Row row{name_of(slot), slot.label, slot.valid, slot.slider, slot.unit, slot.help, std::move(meaning), slot.synonyms};
  row.whole = slot.form == ValueForm::whole;
  row.pointer = slot.pointer;
  return row;
}

void slot_row(Ui& ui, PanelState& state, const Slot& slot, const Row& row) {
  Value value = slot.value;
  double* number = std::get_if<double>(&value);
  Vec3d* vector = std::get_if<Vec3d>(&value);
  Row place = row;
  place.slider = {-ui.size, ui.size};  // a place is dragged by the size of the scene
  const bool changed = slot.form == ValueForm::colour  ? colour_row(ui, row, *vector)
                       : slot.form == ValueForm::place ? vector_row(ui, place, *vector)
                       : !slot.choices.empty()         ? choose(ui, slot, row, *number)
                                                       : slider_row(ui, row, *number);
  if (changed) state.scene.set(slot.pointer, value);
}

void part_rows(Ui& ui, PanelState& state, const std::string& part, const Wanted& wanted, const Said& said) {
  const std::vector<Slot> saved = saved_slots(state, part);
  visit_part(*state.scene, part, [&]<class Owner>(Slot& slot, const Owner& owner) {
    if constexpr (std::is_same_v<Owner, Camera>) fill_in(owner, slot);
    if (!slot.given || (wanted && !wanted(slot))) return false;
    const std::string meaning = meaning_of(owner, slot);
    Row row = row_of(slot, said ? said(slot, meaning) : meaning);
    row.original = original_of(saved, slot);
    slot_row(ui, state, slot, row);
    return false;
  });
}

std::optional<Value> saved_value(const PanelState& state, const std::string& pointer) {
  for (const Slot& slot : saved_slots(state, part_of(pointer)))
    if (slot.pointer == pointer) return slot.value;
  return {};
}

std::string material_part(const Material& material) { return "/materials/" + pointer_step(material.name); }
std::string texture_part(const Texture& texture) { return "/textures/" + pointer_step(texture.name); }

std::string object_part(const ObjectPath& path) {
  std::string part;
  for (const int index : path) part += "/objects/" + std::to_string(index);
  return part;
}

std::vector<std::string> transform_parts(const std::string& owner, const Transform& transform) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < transform.size(); ++k) parts.push_back(owner + "/transform/" + std::to_string(k));
  return parts;
}

}  // namespace tyndall

#include "app/window/panels/rows.h"

#include "app/text/numbers.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {

namespace {

constexpr double degree = pi / 180;

/// 0.0032 -> "0.3 %", 0.47 -> "47 %".
std::string percent(double fraction) {
  const double value = 100 * fraction;
  const double unit = value < 9.95 ? 10 : 1;
  const double shown = std::round(value * unit) / unit;
  std::string text = format_short(shown);
  if (unit == 10 && text.find('.') == std::string::npos) text += ".0";
  return text + " %";
}

std::string format_three(double value) { return fmt::format("{:.3g}", value); }

double luminance(Vec3d c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

std::string degrees_text(double degrees) { return format_short(std::round(10 * degrees) / 10) + "°"; }

/// What a colour does, as the albedo or radiance of a material.
std::string colour_meaning(const Material& material, Vec3d colour) {
  const double y = luminance(colour);
  if (std::holds_alternative<Light<>>(material.kind)) return "luminance " + format_short(y);
  if (!colour_name(material.kind)) return "";
  return "reflects " + percent(y) + " of white light";
}

/// The same of a medium.
std::string albedo_meaning(Vec3d albedo) {
  const double y = luminance(albedo);
  if (y == 0) return "absorbs only";
  if (albedo == Vec3d{1, 1, 1}) return "scatters, absorbs nothing";
  return "absorbs " + percent(1 - y) + " at each event";
}

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
    if (slot.form == ValueForm::colour) return albedo_meaning(std::get<Vec3d>(slot.value));
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

/// Draws a row, and sets the value in the panels' scene when it was changed.
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
  if (changed) state.set_value(slot.pointer, value);
}

}  // namespace

double fuzz_loss(double fuzz) { return 0.1 * fuzz * fuzz; }

double forward_fraction(double g) {
  if (std::abs(g) < 1e-3) return 0.5 + 0.75 * g;  // here the formula below cancels; the next term is of third order
  return (1 - g * g) / (2 * g) * (1 / (1 - g) - 1 / std::sqrt(1 + g * g));
}

SharpRange sharp_range(const Camera& camera, int image_height) {
  const double focus = focus_distance(camera), lens = focus * std::tan(0.5 * degree * camera.defocus_angle);
  const double pixel = 2 * std::tan(0.5 * degree * camera.vfov) / image_height;  // per unit of depth
  // A point at depth z blurs to a disc of 2 lens |focus - z| / z on the plane in focus, whose pixels are pixel · focus.
  const double open = 2 * lens, blur = pixel * focus;
  const double infinite = std::numeric_limits<double>::infinity();
  return {open * focus / (open + blur), open > blur ? open * focus / (open - blur) : infinite};
}

std::string meaning(const Metal<>& metal, std::string_view) {
  if (metal.fuzz == 0) return "a perfect mirror";
  return percent(fuzz_loss(metal.fuzz)) + " of the light lost below the surface";
}

std::string meaning(const Dielectric<>& glass, std::string_view) {
  const double n = glass.refractive_index;
  if (n == 1) return "as the surroundings: invisible";
  // Both fit on one line, so that rows beneath do not jump.
  const std::string head_on = "reflects " + percent(fresnel(1.0, n));
  if (n > 1) return head_on + " head on, all beyond " + degrees_text(std::asin(1 / n) / degree);
  return head_on + ", all beyond " + degrees_text(std::asin(n) / degree) + " outside";
}

std::string meaning(const Medium<>& medium, std::string_view field) {
  if (field == "density")
    return medium.density > 0 ? "mean free path " + format_three(1 / medium.density) : "empty: light passes";
  if (medium.g == 0) return "isotropic: scatters evenly";
  const double forward = forward_fraction(medium.g);
  return medium.g > 0 ? percent(forward) + " goes on forward" : percent(1 - forward) + " goes back";
}

std::string meaning(const Sphere<>& sphere, std::string_view field) {
  if (field == "radius" && sphere.radius < 0) return "negative: the normal points inward";
  if (field == "center_end" && sphere.center_end) return "moves while the shutter is open";
  return "";
}

std::string meaning(const Disk<>& disk, std::string_view field) {
  if (field == "u" || field == "v") return "half axis of " + format_three(length(field == "u" ? disk.u : disk.v));
  if (field == "inner") return disk.inner > 0 ? "a ring: the hole is " + percent(disk.inner) + " as wide" : "no hole";
  return "";
}

std::string meaning(const Camera& camera, std::string_view field) {
  if (field == "vfov") {
    const double lens = 12 / std::tan(0.5 * degree * camera.vfov);  // half of 24 mm
    return "as a " + format_short(lens < 100 ? std::round(lens) : 10 * std::round(lens / 10)) +
           " mm lens on 35 mm film";
  }
  if (field == "defocus_angle") {
    if (camera.defocus_angle == 0) return "a pinhole: all is sharp";
    const double lens = focus_distance(camera) * std::tan(0.5 * degree * camera.defocus_angle);
    return "lens radius " + format_three(lens) + "; Shift+click focuses";
  }
  return "";
}

std::string meaning(const Display& display, std::string_view field) {
  return field == "exposure" ? "brightness × " + format_short(std::exp2(display.exposure)) : "";
}

Row row_of(const Slot& slot, std::string meaning) {
  Row row{name_of(slot), slot.label, slot.valid, slot.slider, slot.unit, slot.help, std::move(meaning), slot.synonyms};
  row.whole = slot.form == ValueForm::whole;
  row.pointer = slot.pointer;
  return row;
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

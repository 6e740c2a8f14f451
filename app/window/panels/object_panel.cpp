#include "app/window/edit/arrange.h"
#include "app/window/edit/material_edits.h"
#include "app/window/panels/rows.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

const Row light_colour_row{"color",     "Colour",
                           at_least(0), {0, 1},
                           "",          "the proportions of red, green and blue",
                           "",          "light color, light colour, lamp color, lamp colour"};
const Row light_power_row{"power",     "Power",
                          at_least(0), {0.01, 1000, true},
                          "",          "radiance of the strongest of red, green and blue",
                          "",          "emission, emissive, intensity, strength, luminance, lamp power, light power"};
const Row light_stops_row{"stops", "Stops",      {}, {}, "", "doubles or halves the light with each stop",
                          "",      "light stops"};
const Row type_of_material{"type", "Type",
                           {},     {},
                           "",     "what kind of material it is; the colour stays",
                           "",     "material type, shader, bsdf, surface, metallic, metalness, transmission, glass"};
const Row material_of_object{
    "material", "Material", {}, {}, "", "which of the scene's materials it has", "", "assign material, materials"};
const Row name_of_object{"name", "Name", {}, {}, "", "of this object: key F2", "", "object title"};
const Row texture_file{"file", "Picture", {}, {}, "", "", "", "image texture, texture file, bitmap"};

namespace {

std::string stops_text(double power) {
  if (!(power > 0)) return "dark";
  const double stops = std::log2(power);
  return fmt::format("{:.3g} stops {} 1", std::abs(stops), stops < 0 ? "below" : "above");
}

/// Buttons that make a light brighter or darker by stops.
void stops_row(Ui& ui, double& power) {
  static constexpr std::pair<const char*, double> buttons[] = {
      {"- 1", -1}, {"- 1/3", -1 / 3.0}, {"+ 1/3", 1 / 3.0}, {"+ 1", 1}};
  begin_row(ui, light_stops_row);
  const float space = 2 * ui.scale, width = (value_width(ui) - 3 * space) / 4;
  for (const auto& button : buttons) {
    if (&button != buttons) ImGui::SameLine(0, space);
    if (small_button(ui, std::string("stops.") + button.first, button.first, width))
      power = without_noise(
          rounded(power * std::exp2(button.second), {1, decimal_below(std::max(power, 1e-30)).exponent - 3}));
  }
  end_row(ui, {});
}

/// A light's radiance as colour times power.
void light_rows(Ui& ui, PanelState& state, const Slot& radiance) {
  const auto saved = saved_value(state, radiance.pointer);
  const LightColour before = light_colour(std::get<Vec3d>(radiance.value));
  const LightColour was = light_colour(saved ? std::get<Vec3d>(*saved) : Vec3d{1, 1, 1});
  LightColour light = before;
  Row colour = light_colour_row, power = light_power_row;
  colour.original = was.colour;
  power.meaning = stops_text(light.power);
  power.original = Vec3d{was.power, 0, 0};
  colour_row(ui, colour, light.colour);
  slider_row(ui, power, light.power);
  stops_row(ui, light.power);
  if (light.power != before.power || !(light.colour == before.colour))
    state.set_value(radiance.pointer, light_radiance(light));
}

void type_row(Ui& ui, PanelState& state, ObjectPath& path) {
  const auto types = surface_types();
  std::vector<std::string> missing;
  for (int k = 0; k < static_cast<int>(types.size()); ++k) missing.push_back(why_not(*state.scene, path, k));
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < types.size(); ++k)
    choices.push_back({types[k], missing[k].empty() ? nullptr : missing[k].c_str()});
  int type = surface_type(*state.scene, path);
  if (combo_row(ui, type_of_material, choices, type))
    path = set_surface_type(state.scene.change(), path, type, state.materials);
}

/// Which texture a colour comes from, and the values of that; nothing for a colour of its own. colour_in: finds it in a
/// scene.
void texture_rows(Ui& ui, PanelState& state, const char* name, const auto& colour_in) {
  const TextureIndex* texture = std::get_if<TextureIndex>(&colour_in(*state.scene));
  if (!texture) return;
  int index = texture->index;
  std::vector<Choice> names;
  for (const Texture& one : state.scene->textures) names.push_back({printable(one.name)});
  const Slot colour = colour_slot("", name, {});
  if (combo_row(ui, {name, colour.label, {}, {}, "", colour.help, "", colour.synonyms}, names, index))
    colour_in(state.scene.change()) = TextureIndex{index};
  const Texture& now = state.scene->textures[static_cast<std::size_t>(index)];
  const Scope scope(ui, now.name);
  if (const Image* image = std::get_if<Image>(&now.kind)) file_row(ui, texture_file, image->file);
  part_rows(ui, state, texture_part(now));
}

/// The values of a material. brief: without the line that tells what its colour does.
void material_rows(Ui& ui, PanelState& state, int index, bool brief) {
  const auto number = static_cast<std::size_t>(index);
  const Material& material = state.scene->materials[number];
  const Scope scope(ui, material.name);
  const bool shines = std::holds_alternative<Light<>>(material.kind);
  const auto said = [&](const Slot& slot, const std::string& meaning) {
    return brief && slot.form == ValueForm::colour ? "" : meaning;
  };
  part_rows(
      ui, state, material_part(material), [&](const Slot&) { return !shines; }, said);
  if (const char* name = colour_name(material.kind))
    texture_rows(
        ui, state, name, [&](auto& scene) -> auto& { return scene.materials[number].colour; });
  if (const auto radiance = shines ? find_slot(*state.scene, material_part(material) + "/radiance") : std::nullopt)
    light_rows(ui, state, *radiance);
}

/// Which type and which material the object at a path has, and a material of its own. May change the path, where fog
/// goes that stood before the object.
void surface_rows(Ui& ui, PanelState& state, ObjectPath& path) {
  type_row(ui, state, path);
  int material = std::get<Solid3d>(find_object(*state.scene, path)->kind).material;
  std::vector<Choice> names;
  for (const Material& one : state.scene->materials) names.push_back({printable(one.name)});
  const int users = users_of(*state.scene, material);
  Row row = material_of_object;
  if (users > 1) row.meaning = "shared by " + std::to_string(users) + " objects: all of them change";
  if (combo_row(ui, row, names, material))
    std::get<Solid3d>(find_object(state.scene.change(), path)->kind).material = material;
  if (users < 2) return;
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - value_width(ui));
  if (small_button(ui, "single_user", "make single user")) make_single_user(state.scene.change(), path);
}

std::string kinds_of(const Scene& scene, const Object& object) {
  if (const Volume* volume = std::get_if<Volume>(&object.kind))
    return std::string(std::holds_alternative<Box<>>(volume->boundary) ? "box" : "sphere") + " · medium";
  const Material* material = material_of(scene, object);
  return kind_name(object) + (material ? std::string(" · ") + material_name(*material) : "");
}

/// The rows that are shown of an object while nothing is selected: its material, and a metal sphere's radius.
void brief_section(Ui& ui, PanelState& state, const ObjectPath& path) {
  const Object& object = *find_object(*state.scene, path);
  const std::string title = title_of(*state.scene, path), part = object_part(path);
  if (!section(ui, title, kinds_of(*state.scene, object))) return;
  const Solid3d* solid = std::get_if<Solid3d>(&object.kind);
  if (solid) material_rows(ui, state, solid->material, true);
  const bool metal_sphere =
      shape_of<Sphere<>>(object) && solid && std::holds_alternative<Metal<>>(material_of(*state.scene, object)->kind);
  const Scope scope(ui, title);
  part_rows(ui, state, part, [&](const Slot& slot) {
    return solid ? metal_sphere && slot.name == std::string_view("radius") : slot.form != ValueForm::colour;
  });
}

/// The rows of a solid, a medium or a group, but for its name.
void kind_rows(Ui& ui, PanelState& state, const ObjectPath& path) {
  const Object& object = *find_object(*state.scene, path);
  const std::string part = object_part(path);
  part_rows(ui, state, part);
  if (const Volume* volume = std::get_if<Volume>(&object.kind)) {
    texture_rows(
        ui, state,
        "albedo", [&](auto& scene) -> auto& { return std::get<Volume>(find_object(scene, path)->kind).albedo; });
    part_rows(ui, state, part + "/boundary");
    for (const std::string& step : transform_parts(part + "/boundary", volume->boundary_transform))
      part_rows(ui, state, step);
  }
  if (const Group* group = std::get_if<Group>(&object.kind))
    note(ui, std::to_string(group->objects.size()) + " objects", false);
  for (const std::string& step : transform_parts(part, object.transform)) part_rows(ui, state, step);
}

void full_section(Ui& ui, PanelState& state) {
  ObjectPath& path = state.selected;
  const Object* object = find_object(*state.scene, path);
  const std::string title = title_of(*state.scene, path), also = std::to_string(state.also.size());
  if (!section(ui, title, state.also.empty() ? kinds_of(*state.scene, *object) : "and " + also + " more")) return;
  const Solid3d* solid = std::get_if<Solid3d>(&object->kind);
  if (solid) material_rows(ui, state, solid->material, false);
  const Scope scope(ui, title);
  if (solid) surface_rows(ui, state, path);  // another type may move it in its list
  kind_rows(ui, state, path);
  std::string typed = find_object(*state.scene, path)->name;
  if (name_row(ui, name_of_object, title, state.rename, typed)) find_object(state.scene.change(), path)->name = typed;
  state.rename = false;
}

}  // namespace

ObjectPaths all_selected(const PanelState& state) {
  ObjectPaths all;
  if (!state.selected.empty()) all.push_back(state.selected);
  all.insert(all.end(), state.also.begin(), state.also.end());
  return all;
}

void set_selected(PanelState& state, const ObjectPaths& paths) {
  state.selected = paths.empty() ? ObjectPath{} : paths.front();
  state.also.assign(paths.begin() + (paths.empty() ? 0 : 1), paths.end());
}

void forget_scene(PanelState& state) {
  state.objects = {};
  state.backgrounds = {};
  state.materials = {};
}

void object_panel(Ui& ui, PanelState& state) {
  if (find_object(*state.scene, state.selected)) {
    if (state.rename) ui.folded.erase(title_of(*state.scene, state.selected));
    ImGui::PushID("selected");
    full_section(ui, state);
    ImGui::PopID();
    return;
  }
  for (const ObjectPath& path : interesting(*state.scene)) {
    ImGui::PushID(path.back());
    brief_section(ui, state, path);
    ImGui::PopID();
  }
}

}  // namespace tyndall

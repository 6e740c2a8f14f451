#include "app/window/edit/arrange.h"
#include "app/window/edit/material_edits.h"
#include "app/window/panels/field_rows.h"
#include "app/window/panels/panels.h"
#include "core/base/kinds.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// The thing of that name in the scene's file; null: it has none.
template <class Named>
const Named* saved_of(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
  return found == list.end() ? nullptr : &*found;
}

std::string stops_text(double power) {
  if (!(power > 0)) return "dark";
  const double stops = std::log2(power);
  return fmt::format("{:.3g} stops {} 1", std::abs(stops), stops < 0 ? "below" : "above");
}

/// Buttons that make a light brighter or darker by stops.
void stops_row(Ui& ui, double& power) {
  static constexpr struct {
    const char* name;
    double stops;
  } buttons[] = {{"- 1", -1}, {"- 1/3", -1 / 3.0}, {"+ 1/3", 1 / 3.0}, {"+ 1", 1}};
  begin_row(ui, {"stops", "Stops", {}, {}, "", "doubles or halves the light with each stop", ""});
  const float space = 2 * ui.scale, width = (value_width(ui) - 3 * space) / 4;
  for (const auto& button : buttons) {
    if (&button != buttons) ImGui::SameLine(0, space);
    if (small_button(ui, std::string("stops.") + button.name, button.name, width))
      power = without_noise(
          rounded(power * std::exp2(button.stops), {1, decimal_below(std::max(power, 1e-30)).exponent - 3}));
  }
  end_row(ui, {});
}

/// A light's radiance as colour times power.
void light_rows(Ui& ui, Vec3d& radiance, const ColourOrTexture* saved) {
  const Vec3d* original = saved ? std::get_if<Vec3d>(saved) : nullptr;
  const LightColour before = light_colour(radiance), was = light_colour(original ? *original : Vec3d{1, 1, 1});
  LightColour light = before;
  Row colour{"color", "Colour", at_least(0), {0, 1}, "", "the proportions of red, green and blue", ""};
  colour.original = was.colour;
  Row power{"power", "Power", at_least(0), {0.01, 1000, true}, "", "radiance of the strongest of red, green and blue",
            ""};
  power.original = Vec3d{was.power, 0, 0};
  power.meaning = stops_text(light.power);
  colour_row(ui, colour, light.colour);
  slider_row(ui, power, light.power);
  stops_row(ui, light.power);
  if (light.power != before.power || !(light.colour == before.colour)) radiance = light_radiance(light);
}

void texture_rows(Ui& ui, PanelState& state, Texture& texture) {
  const Scope scope(ui, texture.name);
  const Texture* saved = saved_of(state.model.saved->textures, texture.name);
  std::visit(Overloaded{[&](Image& image) {
                          text_row(ui, {"file", "Picture", {}, {}, "", image.file, ""}, image.file);
                        },
                        [&](auto& kind) { field_rows(ui, kind, same_kind(kind, saved ? &saved->kind : nullptr)); }},
             texture.kind);
}

void type_row(Ui& ui, PanelState& state, ObjectPath& path) {
  const auto types = surface_types();
  std::vector<std::string> missing;
  for (int k = 0; k < static_cast<int>(types.size()); ++k) missing.push_back(why_not(state.scene, path, k));
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < types.size(); ++k)
    choices.push_back({types[k], missing[k].empty() ? nullptr : missing[k].c_str()});
  int type = surface_type(state.scene, path);
  Row row{"type", "Type", {}, {}, "", "what kind of material it is; the colour stays", ""};
  if (combo_row(ui, row, choices, type)) path = set_surface_type(state.scene, path, type, state.materials);
}

/// Texture, or colour, of a material or medium, with the fields of the texture. saved: in the scene's file; may be
/// null.
void colour_rows(Ui& ui, PanelState& state, ColourOrTexture& colour, const ColourOrTexture* saved, Row row) {
  if (Vec3d* rgb = std::get_if<Vec3d>(&colour)) {
    if (const Vec3d* original = saved ? std::get_if<Vec3d>(saved) : nullptr) row.original = *original;
    colour_row(ui, row, *rgb);
    return;
  }
  int& index = std::get<TextureIndex>(colour).index;
  std::vector<std::string> names;
  for (const Texture& texture : state.scene.textures) names.push_back(printable(texture.name));
  combo_row(ui, row, names, index);
  texture_rows(ui, state, state.scene.textures[static_cast<std::size_t>(index)]);
}

/// The values of a material. brief: without the line that tells what its colour does.
void material_rows(Ui& ui, PanelState& state, int index, bool brief) {
  Material& material = state.scene.materials[static_cast<std::size_t>(index)];
  const Material* saved = saved_of(state.model.saved->materials, material.name);
  const Scope scope(ui, material.name);
  std::visit([&](auto& kind) { field_rows(ui, kind, same_kind(kind, saved ? &saved->kind : nullptr)); }, material.kind);
  const char* name = colour_name(material.kind);
  if (!name) return;
  Vec3d* colour = std::get_if<Vec3d>(&material.colour);
  const ColourOrTexture* original = saved && colour_name(saved->kind) ? &saved->colour : nullptr;
  if (colour && std::holds_alternative<Light<>>(material.kind)) return light_rows(ui, *colour, original);
  Row row = row_of(name, colour_meaning(name), "");
  if (colour && !brief) row.meaning = colour_meaning(material, *colour);
  colour_rows(ui, state, material.colour, original, std::move(row));
}

/// Which type and which material the object at a path has, and a material of its own. May change the path, where fog
/// goes that stood before the object.
void surface_rows(Ui& ui, PanelState& state, ObjectPath& path) {
  type_row(ui, state, path);
  Solid3d& solid = std::get<Solid3d>(find_object(state.scene, path)->kind);
  std::vector<std::string> names;
  for (const Material& material : state.scene.materials) names.push_back(printable(material.name));
  const int users = users_of(state.scene, solid.material);
  Row row{"material", "Material", {}, {}, "", "which of the scene's materials it has", ""};
  if (users > 1) row.meaning = "shared by " + std::to_string(users) + " objects: all of them change";
  combo_row(ui, row, names, solid.material);
  if (users < 2) return;
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - value_width(ui));
  if (small_button(ui, "single_user", "make single user")) make_single_user(state.scene, path);
}

/// The object's counterpart in the scene's file; null: it has none at that path.
const Object* saved_object(const PanelState& state, const ObjectPath& path) {
  const Object *now = find_object(state.scene, path), *saved = find_object(*state.model.saved, path);
  return saved && saved->name == now->name && saved->kind.index() == now->kind.index() ? saved : nullptr;
}

void transform_rows(Ui& ui, const char* prefix, Transform& transform, const Transform* saved) {
  int number = 0;
  for (auto& step : transform)
    std::visit(
        [&]<class Step>(Step& move) {
          const auto field = std::get<0>(fields_of<Step>());
          Row row = row_of(field, "");
          const auto k = static_cast<std::size_t>(number);
          const Step* original = saved && k < saved->size() ? std::get_if<Step>(&(*saved)[k]) : nullptr;
          if (original) row.original = original_of(original->*field.value);
          row.name = prefix + std::to_string(number++);
          value_row(ui, std::move(row), move.*field.value);
        },
        step);
}

void medium_rows(Ui& ui, PanelState& state, Volume& volume, const Volume* saved) {
  field_rows(ui, volume.medium, saved ? &saved->medium : nullptr);
  Row row = row_of("albedo", colour_meaning("albedo"), "");
  if (const Vec3d* colour = std::get_if<Vec3d>(&volume.albedo)) row.meaning = albedo_meaning(volume.medium, *colour);
  colour_rows(ui, state, volume.albedo, saved ? &saved->albedo : nullptr, std::move(row));
}

std::string kinds_of(const Scene& scene, const Object& object) {
  if (const Volume* volume = std::get_if<Volume>(&object.kind))
    return std::string(std::holds_alternative<Box<>>(volume->boundary) ? "box" : "sphere") + " · medium";
  const Material* material = material_of(scene, object);
  return kind_name(object) + (material ? std::string(" · ") + material_name(*material) : "");
}

/// The rows that are shown of an object while nothing is selected: its material, and a metal sphere's radius.
void brief_section(Ui& ui, PanelState& state, const ObjectPath& path) {
  Object& object = *find_object(state.scene, path);
  const Object* saved = saved_object(state, path);
  if (!section(ui, title_of(state.scene, path), kinds_of(state.scene, object))) return;
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    const Scope scope(ui, title_of(state.scene, path));
    field_rows(ui, volume->medium, saved ? &std::get<Volume>(saved->kind).medium : nullptr);
    return;
  }
  Solid3d& solid = std::get<Solid3d>(object.kind);
  material_rows(ui, state, solid.material, true);
  Sphere<>* sphere = std::get_if<Sphere<>>(&solid.shape);
  if (!sphere || !std::holds_alternative<Metal<>>(material_of(state.scene, object)->kind)) return;
  const Scope scope(ui, title_of(state.scene, path));
  const Sphere<>* original = same_kind(*sphere, saved ? &std::get<Solid3d>(saved->kind).shape : nullptr);
  field_rows(ui, *sphere, original, [](const auto&, std::string_view name) { return name == "radius"; });
}

void shape_rows(Ui& ui, auto& shape, const auto* saved) {
  std::visit([&](auto& kind) { field_rows(ui, kind, same_kind(kind, saved)); }, shape);
}

/// The rows of a solid, a medium or a group, but for its name and its own transform.
void kind_rows(Ui& ui, PanelState& state, Object& object, const Object* saved) {
  if (Solid3d* solid = std::get_if<Solid3d>(&object.kind))
    return shape_rows(ui, solid->shape, saved ? &std::get<Solid3d>(saved->kind).shape : nullptr);
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    const Volume* before = saved ? &std::get<Volume>(saved->kind) : nullptr;
    medium_rows(ui, state, *volume, before);
    shape_rows(ui, volume->boundary, before ? &before->boundary : nullptr);
    return transform_rows(ui, "boundary", volume->boundary_transform, before ? &before->boundary_transform : nullptr);
  }
  note(ui, std::to_string(std::get<Group>(object.kind).objects.size()) + " objects", false);
}

void full_section(Ui& ui, PanelState& state) {
  ObjectPath& path = state.selected;
  const Object* object = find_object(state.scene, path);
  const std::string title = title_of(state.scene, path), also = std::to_string(state.also.size());
  if (!section(ui, title, state.also.empty() ? kinds_of(state.scene, *object) : "and " + also + " more")) return;
  const Solid3d* solid = std::get_if<Solid3d>(&object->kind);
  if (solid) material_rows(ui, state, solid->material, false);
  const Scope scope(ui, title);
  if (solid) surface_rows(ui, state, path);
  Object& now = *find_object(state.scene, path);  // another type may have moved it in its list
  const Object* saved = saved_object(state, path);
  kind_rows(ui, state, now, saved);
  transform_rows(ui, "transform", now.transform, saved ? &saved->transform : nullptr);
  const Row name{"name", "Name", {}, {}, "", "of this object: key F2", ""};
  name_row(ui, name, title, state.rename, now.name);
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
  if (find_object(state.scene, state.selected)) {
    if (state.rename) ui.folded.erase(title_of(state.scene, state.selected));
    ImGui::PushID("selected");
    full_section(ui, state);
    ImGui::PopID();
    return;
  }
  for (const ObjectPath& path : interesting(state.scene)) {
    ImGui::PushID(path.back());
    brief_section(ui, state, path);
    ImGui::PopID();
  }
}

}  // namespace tyndall

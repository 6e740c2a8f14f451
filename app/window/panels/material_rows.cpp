#include "app/window/panels/material_rows.h"

#include "app/window/edit/drag_rounding.h"
#include "app/window/edit/material_edits.h"
#include "app/window/panels/field_rows.h"
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

}  // namespace

Scope::Scope(Ui& ui, const std::string& name) : ui_(ui), before_(ui.scope) {
  ui.scope += name + ".";
  ImGui::PushID(ui.scope.c_str());
}
Scope::~Scope() {
  ImGui::PopID();
  ui_.scope = before_;
}

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

}  // namespace tyndall

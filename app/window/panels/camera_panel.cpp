#include "app/window/panels/field_rows.h"
#include "app/window/panels/panels.h"
#include "app/window/tools/camera_control.h"
#include "core/base/kinds.h"

#include <cmath>

namespace tyndall {
namespace {

std::string focus_meaning(const Scene& scene) {
  const Camera& camera = scene.camera;
  if (camera.defocus_angle == 0) return "";
  const SharpRange sharp = sharp_range(camera, scene.height);
  if (!std::isfinite(sharp.far)) return "sharp from " + format_short(sharp.near) + " on";
  return "sharp from " + format_short(sharp.near) + " to " + format_short(sharp.far);
}

/// Shows the distance that is in use, also where the scene leaves it open.
void focus_row(Ui& ui, Scene& scene) {
  Camera shown = scene.camera;
  const double before = focus_distance(shown);
  shown.focus_distance = before;
  field_rows(
      ui, shown, [](const auto& value, auto name) { return is_any_of<std::optional<double>>(value, name); },
      [&](std::string_view) { return focus_meaning(scene); });
  if (*shown.focus_distance != before) scene.camera.focus_distance = shown.focus_distance;
}

/// What a background can be, by the kind's place in the variant.
template <class... Skies>
std::vector<Choice> sky_choices(const std::variant<Vec3d, Skies...>&) {
  return {{"colour"}, {Skies::type}...};
}

}  // namespace

void camera_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Camera", "Home: reset")) return;
  ui.scope = "camera.";
  Camera& camera = state.scene.camera;
  field_rows(ui, camera, [](const auto& value, auto name) { return is_any_of<double>(value, name); });
  focus_row(ui, state.scene);
  const bool plain_up = camera.vup == Vec3d{0, 1, 0};
  field_rows(ui, camera, [&](const auto& value, std::string_view name) {
    return is_any_of<Vec3d>(value, name) && !(plain_up && name == "vup");
  });
  ui.scope.clear();
}

void background_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Background", "seen beyond all objects")) return;
  ui.scope = "background.";
  Background& background = state.scene.background;
  int kind = static_cast<int>(background.index());
  if (choice_row(ui, {"kind", "Kind", {}, {}, "", "", ""}, sky_choices(background), kind)) set_kind(background, kind);
  std::visit(Overloaded{[&](Vec3d& constant) {
                          Meaning radiance = colour_meaning("radiance");
                          radiance.slider.high = 2;
                          colour_row(ui, row_of("colour", radiance, ""), constant);
                        },
                        [&](auto& sky) { field_rows(ui, sky); }},
             background);
  ui.scope.clear();
}

}  // namespace tyndall

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
void focus_row(Ui& ui, Scene& scene, const Camera& saved) {
  Camera shown = scene.camera, original = saved;
  const double before = focus_distance(shown);
  shown.focus_distance = before;
  original.focus_distance = focus_distance(saved);
  field_rows(
      ui, shown, &original, [](const auto& value, auto name) { return is_any_of<std::optional<double>>(value, name); },
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
  const Camera* saved = &state.model.saved->camera;
  field_rows(ui, camera, saved, [](const auto& value, auto name) { return is_any_of<double>(value, name); });
  focus_row(ui, state.scene, *saved);
  const bool plain_up = camera.vup == Vec3d{0, 1, 0} && !is_sought(ui, label_of("vup"));
  field_rows(ui, camera, saved, [&](const auto& value, std::string_view name) {
    return is_any_of<Vec3d>(value, name) && !(plain_up && name == "vup");
  });
  CameraSlots& slots = state.cameras[state.model.title];
  const SlotWish wish = camera_slots_row(ui, slots, camera);
  if (wish.recall) camera = slots[*wish.recall].camera;
  if (wish.store) store_camera(slots, camera, state.model.frame.get(), state.scene.display);
  ui.scope.clear();
}

void background_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Background", "seen beyond all objects")) return;
  ui.scope = "background.";
  Background& background = state.scene.background;
  const Background& saved = state.model.saved->background;
  int kind = static_cast<int>(background.index());
  if (choice_row(ui, {"kind", "Kind", {}, {}, "", "", ""}, sky_choices(background), kind))
    set_background_kind(background, kind, state.backgrounds);
  std::visit(Overloaded{[&](Vec3d& constant) {
                          Meaning radiance = colour_meaning("radiance");
                          radiance.slider.high = 2;
                          Row row = row_of("colour", radiance, "");
                          if (const Vec3d* original = std::get_if<Vec3d>(&saved)) row.original = *original;
                          colour_row(ui, row, constant);
                        },
                        [&](auto& sky) { field_rows(ui, sky, same_kind(sky, &saved)); }},
             background);
  ui.scope.clear();
}

}  // namespace tyndall

#include "app/window/panels/field_rows.h"
#include "app/window/panels/panels.h"
#include "app/window/tools/camera_control.h"

#include <cmath>
#include <type_traits>

namespace tyndall {
namespace {

std::string focus_meaning(const Scene& scene) {
  const Camera& camera = scene.camera;
  if (camera.defocus_angle == 0) return "";
  const SharpRange sharp = sharp_range(camera, scene.height);
  if (!std::isfinite(sharp.far)) return "sharp from " + format_short(sharp.near) + " on";
  return "sharp from " + format_short(sharp.near) + " to " + format_short(sharp.far);
}

void focus_row(Ui& ui, Scene& scene) {
  double distance = focus_distance(scene.camera);
  const Row row{"focus_distance",
                label_of("focus_distance"),
                above(0),
                {0.1, 100, true},
                "",
                "distance of the plane in focus, along the axis; Shift + click focuses on a point",
                focus_meaning(scene)};
  if (slider_row(ui, row, distance)) scene.camera.focus_distance = distance;
}

}  // namespace

void camera_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Camera", "Home: reset")) return;
  ui.scope = "camera.";
  Camera& camera = state.scene.camera;
  field_rows(ui, camera,
             [](const auto& value, std::string_view) { return std::is_same_v<std::decay_t<decltype(value)>, double>; });
  focus_row(ui, state.scene);
  const bool plain_up = camera.vup == Vec3d{0, 1, 0};
  field_rows(ui, camera, [&](const auto& value, std::string_view name) {
    return std::is_same_v<std::decay_t<decltype(value)>, Vec3d> && !(plain_up && name == "vup");
  });
  ui.scope.clear();
}

void background_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Background", "what escaping light sees")) return;
  ui.scope = "background.";
  static constexpr Choice kinds[] = {{"colour"}, {"gradient"}, {"hemispheres"}};
  Background& background = state.scene.background;
  int kind = static_cast<int>(background.index());
  if (choice_row(ui, {"kind", "Kind", {}, {}, "", "", ""}, kinds, kind)) {
    if (kind == 0) background = Vec3d{0, 0, 0};
    if (kind == 1) background = Gradient{};
    if (kind == 2) background = Hemispheres{};
  }
  const auto colour = [&](const char* name, const char* label, Vec3d& value) {
    colour_row(ui, {name, label, at_least(0), {0, 2}, "", "radiance, linear RGB", ""}, value);
  };
  if (Vec3d* constant = std::get_if<Vec3d>(&background)) colour("colour", "Radiance", *constant);
  if (Gradient* gradient = std::get_if<Gradient>(&background)) {
    colour("top", "Top", gradient->top);
    colour("bottom", "Bottom", gradient->bottom);
  }
  if (Hemispheres* halves = std::get_if<Hemispheres>(&background)) {
    colour("up", "Above", halves->up);
    colour("down", "Below", halves->down);
  }
  ui.scope.clear();
}

}  // namespace tyndall

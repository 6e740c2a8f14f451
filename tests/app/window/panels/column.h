#pragma once
#include "app/window/accuracy/views.h"
#include "app/window/panels/panels.h"
#include "app/window/system/style.h"
#include "app/window/system/ui_log.h"
#include "tests/app/window/panels/null_imgui.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/// The column of panels for tests, without a window.
namespace tyndall {

/// The column over a scene, driven by a mouse that aims at controls by name.
class TestColumn {
 public:
  TestColumn() : log_("/dev/null") {
    set_style(1);
    ui.log = &log_;
    scene().materials = {{"gold", Vec3d{0.9, 0.6, 0.3}, Metal<>{0.18}}, {"glass", {}, Dielectric<>{2.0 / 3}}};
    scene().objects = {{"ball", Solid3d{Sphere<>{{0, 0, 0}, 0.7, {}}, 0}, {}},
                       {"bubble", Solid3d{Sphere<>{{2, 0, 0}, -0.9, {}}, 1}, {RotateY{30}}},
                       {"fog", Volume{Box<>{}, {}, Medium<>{1.1, 0}, Vec3d{1, 1, 1}}, {}}};
    scene().camera.look_from = {0, 1, 6};
    saved = scene();
    state.now.origin = origin;
    state.now.accuracy = &accuracy_;
    state.look = &look;
    state.set_value = [this](const std::string& pointer, const Value& value) { put_value(scene(), pointer, value); };
    state.now.scenes = {{"showroom", "Showroom", "", "showroom.json"},
                        {"cover", "Cover", "Stress: many balls. Fails: slow trees. Right: a cover.", "cover.json"}};
    origin->title = "showroom";
    draw();
    draw();
  }

  void draw() {
    imgui_.frame([&] {
      ui.problem.clear();
      if (state.scene.is_changed()) state.scene = EditedScene(std::make_shared<const Scene>(*state.scene.take()));
      state.wanted_pictures.clear();
      draw_column(ui, state, {0, 0, 372, height});
      log_.end_of_widgets();
      changed = state.scene.is_changed();
      if (!ui.problem.empty()) problem = ui.problem;
      for (const Request& request : std::exchange(ui.requests, {})) {
        if (request.command.starts_with("view: ")) state.now.view = view_named(request.command.substr(6));
        requested.push_back(request);
      }
    });
  }
  /// All rows of the column, also those that are folded.
  std::vector<RowEntry> all_rows() {
    std::vector<RowEntry> rows;
    imgui_.frame([&] {
      draw_column(ui, state, {0, 0, 372, height});
      rows = rows_of_column(ui, state);
    });
    return rows;
  }
  bool has_query_for(const Request& request) const {
    return std::find(requested.begin(), requested.end(), request) != requested.end();
  }
  bool has(const std::string& name) const { return log_.find(name).has_value(); }
  Rect rect(const std::string& name) const { return *log_.find(name); }
  /// Puts the mouse on a control: across from 0 to 1.
  void aim(const std::string& name, double across = 0.5) {
    const auto rect = log_.find(name);
    REQUIRE_MESSAGE(rect, name);
    compat::mouse_pos(ImGui::GetIO(), rect->x0 + static_cast<float>(across) * rect->width(), (rect->y0 + rect->y1) / 2);
    draw();
  }
  void button(bool down, int which = 0) {
    compat::mouse_button(ImGui::GetIO(), which, down);
    draw();
  }
  void click(const std::string& name, double across = 0.5) {
    aim(name, across);
    button(true);
    button(false);
    draw();
  }
  void type(const std::string& name, const char* text) {
    click(name);
    draw();
    for (const char* c = text; *c; ++c) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
    draw();
    press(ImGuiKey_Enter);
  }
  /// Two clicks on a control, quick after each other.
  void click_twice(const std::string& name, double across = 0.5) {
    aim(name, across);
    for (int k = 0; k < 2; ++k) button(true), button(false);
    draw();
    draw();
  }
  void press(ImGuiKey key) {
    compat::key(ImGui::GetIO(), key, true);
    draw();
    compat::key(ImGui::GetIO(), key, false);
    draw();
    draw();
  }

  /// The scene under edit; the next drawing finds it as it is left here.
  Scene& scene() { return state.scene.change(); }
  const Scene& scene() const { return *state.scene; }
  Metal<>& gold() { return std::get<Metal<>>(scene().materials[0].kind); }
  Dielectric<>& glass() { return std::get<Dielectric<>>(scene().materials[1].kind); }

  Ui ui;
  Preferences look;
  PanelState state;
  bool changed = false;  ///< the last drawing has edited the scene
  std::shared_ptr<Origin> origin = std::make_shared<Origin>();
  Scene& saved = origin->saved;  ///< what the file holds
  float height = 2400;
  std::string problem;
  std::vector<Request> requested;  ///< all that it has asked for

 private:
  NullImGui imgui_{372, 2400};
  UiLog log_;
  LiveAccuracy accuracy_{[] {}};
};

}  // namespace tyndall

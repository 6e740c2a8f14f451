#pragma once
#include "app/window/accuracy/views.h"
#include "app/window/panels/panels.h"
#include "app/window/system/style.h"
#include "app/window/system/ui_log.h"
#include "tests/app/window/null_imgui.h"
#include "tests/app/window/scenes.h"

#include <algorithm>
#include <utility>

/// The column of panels for tests, without a window.
namespace tyndall::test {

/// The column over a scene, driven by a mouse that aims at controls by name.
class TestColumn {
 public:
  TestColumn() : log_("/dev/null") {
    set_style(1);
    ui.log = &log_;
    scene().materials = {{"gold", Vec3d{0.9, 0.6, 0.3}, Metal<>{0.18}}, {"glass", {}, Dielectric<>{2.0 / 3}}};
    scene().objects = {ball("ball", {0, 0, 0}, 0.7),
                       ball("bubble", {2, 0, 0}, -0.9, 1),
                       {"fog", Volume{Box<>{}, {}, Medium<>{1.1, 0}, Vec3d{1, 1, 1}}, {}}};
    scene().objects[1].transform = {RotateY{30}};
    scene().camera.look_from = {0, 1, 6};
    saved = scene();
    state.now.origin = origin;
    state.now.accuracy = &accuracy_;
    state.look = &look;
    state.set_value = [this](const std::string& pointer, const Value& value) { put_value(scene(), pointer, value); };
    state.now.scenes = {{"showroom", "Showroom", "", "showroom.json"},
                        {"cover", "Cover", "Stress: many balls. Fails: slow trees. Right: a cover.", "cover.json"}};
    origin->title = "showroom";
    draw(2);
  }

  void draw(int times = 1) {
    for (int k = 0; k < times; ++k) draw_once();
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
  bool has(const std::string& name) const { return log_.find(name).has_value(); }
  Rect rect(const std::string& name) const { return *log_.find(name); }
  bool has_keyboard() const { return ui.edit.id != 0; }

  void move_mouse(float x, float y) {
    compat::mouse_pos(ImGui::GetIO(), x, y);
    draw();
  }
  /// Puts the mouse on a control: across from 0 to 1.
  void aim(const std::string& name, double across = 0.5) {
    REQUIRE_MESSAGE(has(name), name);
    const Rect at = rect(name);
    move_mouse(at.x0 + static_cast<float>(across) * at.width(), (at.y0 + at.y1) / 2);
  }
  void button(bool down, int which = 0) {
    compat::mouse_button(ImGui::GetIO(), which, down);
    draw();
  }
  /// One or more clicks on a control, quick after each other.
  void click(const std::string& name, double across = 0.5, int times = 1, int which = 0) {
    aim(name, across);
    for (int k = 0; k < times; ++k) button(true, which), button(false, which);
    draw(2);
  }
  void click_twice(const std::string& name, double across = 0.5) { click(name, across, 2); }
  /// Presses at one place of a control and holds at another one.
  void drag(const std::string& name, double from, double to) {
    aim(name, from);
    button(true);
    aim(name, to);
  }
  void write(const char* text) {
    type_text(text);
    draw();
  }
  void type(const std::string& name, const char* text) {
    click(name);
    write(text);
    press(ImGuiKey_Enter);
  }
  void press(ImGuiKey key) {
    compat::key(ImGui::GetIO(), key, true);
    draw();
    compat::key(ImGui::GetIO(), key, false);
    draw(2);
  }
  void select(const ObjectPath& path) {
    state.selected = path;
    draw(3);
  }

  /// The scene under edit; the next drawing finds it as it is left here.
  Scene& scene() { return state.scene.change(); }
  const Scene& scene() const { return *state.scene; }
  double& fuzz() { return std::get<Metal<>>(scene().materials[0].kind).fuzz; }
  double& refractive_index() { return std::get<Dielectric<>>(scene().materials[1].kind).refractive_index; }
  Vec3d colour() const { return std::get<Vec3d>(scene().materials[0].colour); }
  /// Which part's tab is lit.
  std::string lit() const { return column_sections()[static_cast<std::size_t>(state.tabs.lit)].name; }

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
  void draw_once() {
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

  NullImGui imgui_{372, 2400};
  UiLog log_;
  LiveAccuracy accuracy_{[] {}};
};

}  // namespace tyndall::test

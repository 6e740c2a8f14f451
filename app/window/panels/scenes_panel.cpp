#include "app/window/panels/list_rows.h"
#include "app/window/panels/panels.h"
#include "app/window/panels/wheel.h"
#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <cstdint>

namespace tyndall {
namespace {

constexpr float row_height = 46, picture_width = 64, picture_height = 40;  // units of the design

/// A scene that can be opened.
struct SceneRow {
  std::string name;     ///< in the log
  std::string what;     ///< what load_scene takes
  std::string label;    ///< its first line
  std::string line;     ///< its second one
  std::string details;  ///< tooltip
};

/// What a scene's file says between two of its words ("Fails:" and "Right:"); "" if it does not say it.
std::string said_after(const std::string& about, const std::string& word, const std::string& next) {
  const std::size_t at = about.find(word);
  if (at == std::string::npos) return "";
  const std::size_t from = at + word.size(), end = std::min(about.find(next, from), about.size());
  return about.substr(from, end - from);
}

std::string without_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The picture in the middle of its place, or an empty place where there is none.
void draw_picture(const Ui& ui, const PanelState& state, const std::string& what, ImVec2 at) {
  const ImVec2 place{picture_width * ui.scale, picture_height * ui.scale};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + place.x, at.y + place.y}, shade(palette::field), 3 * ui.scale);
  if (!state.model.pictures) return;
  const auto found = state.model.pictures->find(what);
  if (found == state.model.pictures->end() || !found->second) return;
  const PictureTexture& picture = *found->second;
  const float fit = std::min(place.x / picture.width(), place.y / picture.height());
  const ImVec2 size{fit * picture.width(), fit * picture.height()};
  const ImVec2 from{at.x + (place.x - size.x) / 2, at.y + (place.y - size.y) / 2};
  const auto texture = (ImTextureID) static_cast<std::intptr_t>(picture.number());  // NOLINT: a pointer before 1.92
  draw->AddImageRounded(texture, from, {from.x + size.x, from.y + size.y}, {0, 0}, {1, 1}, IM_COL32_WHITE,
                        3 * ui.scale);
}

/// Picture, name and a grey line. Returns whether it was clicked.
bool scene_row(Ui& ui, PanelState& state, const SceneRow& row) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float s = ui.scale, right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  const bool on = row.what == state.model.what;
  const ImVec2 size{0, row_height * s - ImGui::GetStyle().ItemSpacing.y};
  const bool pressed = ImGui::Selectable(("##" + row.name).c_str(), on, 0, size);
  log_item(ui, row.name, on ? "on" : "off");
  tooltip(ui, row.details);
  draw_picture(ui, state, row.what, at);
  state.wanted_pictures.push_back(row.what);
  const float left = at.x + (picture_width + 10) * s;
  clipped_text_at(row.label, {left, at.y + 2 * s}, right - left, palette::text);
  compat::push_font(ui.fonts.small);
  clipped_text_at(row.line, {left, at.y + 22 * s}, right - left, palette::dim);
  ImGui::PopFont();
  return pressed;
}

std::vector<SceneRow> rows_of(const std::vector<BuiltIn>& scenes) {
  std::vector<SceneRow> rows;
  for (const BuiltIn& scene : scenes) {
    const std::string fails = without_blanks(said_after(scene.about, "Fails:", "Right:"));
    rows.push_back({scene.name, scene.name, scene.name, fails.empty() ? scene.title : "Fails: " + fails,
                    scene.about.empty() ? scene.title : scene.about});
  }
  return rows;
}

std::vector<SceneRow> rows_of(const std::vector<std::filesystem::path>& files) {
  std::vector<SceneRow> rows;
  for (std::size_t k = 0; k < files.size(); ++k)
    rows.push_back({"recent." + std::to_string(k), files[k].string(), files[k].filename().string(),
                    files[k].parent_path().string(), files[k].string()});
  return rows;
}

/// A list of so many rows at most; those that are not to be seen cost nothing.
void scene_list(Ui& ui, PanelState& state, const char* name, const std::vector<SceneRow>& rows, std::size_t maximum) {
  if (begin_list(ui, name, row_height * ui.scale, rows.size(), maximum)) {
    scroll_list(ui);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), row_height * ui.scale);
    while (clipper.Step())
      for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
        const SceneRow& row = rows[static_cast<std::size_t>(k)];
        if (scene_row(ui, state, row)) state.requests.push_back({Action::scene, 0, row.what});
      }
  }
  end_list();
}

}  // namespace

void scenes_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Scenes", "or drop a file")) return;
  ui.scope = "scenes.";
  scene_list(ui, state, "scenes", rows_of(state.model.scenes), 6);
  const std::vector<SceneRow> recent = rows_of(state.model.recent);
  if (!recent.empty()) {
    note(ui, "Opened before", false);
    scene_list(ui, state, "recent", recent, 3);
  }
  ui.scope.clear();
}

void window_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Window", "remembered")) return;
  ui.scope = "window.";
  static constexpr Choice themes[] = {{"dark"}, {"light"}};
  int theme = static_cast<int>(state.look.theme);
  if (choice_row(ui, {"theme", "Theme", {}, {}, "", "of panels and lines; the picture stays as it is", ""}, themes,
                 theme))
    state.look.theme = static_cast<Theme>(theme);
  std::vector<std::string> names;
  std::vector<Choice> sizes;
  for (const double size : text_sizes) names.push_back(format_short(100 * size));
  for (const std::string& name : names) sizes.push_back({name.c_str()});
  int chosen =
      static_cast<int>(std::find(text_sizes.begin(), text_sizes.end(), state.look.text_size) - text_sizes.begin());
  if (choice_row(ui, {"text", "Text size, %", {}, {}, "", "of all controls: Ctrl + and Ctrl -", ""}, sizes, chosen))
    state.look.text_size = text_sizes[static_cast<std::size_t>(chosen)];
  ui.scope.clear();
}

}  // namespace tyndall

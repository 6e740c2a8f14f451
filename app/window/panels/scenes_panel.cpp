#include "app/window/panels/list_rows.h"
#include "app/window/panels/panels.h"
#include "app/window/panels/wheel.h"
#include "app/window/system/imgui_compat.h"

#include <algorithm>

namespace tyndall {

bool list_line(Ui& ui, const std::string& name, const std::string& label, const std::string& word, bool on) {
  const float right = ImGui::GetWindowContentRegionMax().x;
  const bool pressed = ImGui::Selectable(("##" + name).c_str(), on, 0, {0, ImGui::GetTextLineHeight()});
  log_item(ui, name, on ? "on" : "off");
  ImGui::SameLine(ImGui::GetStyle().ItemSpacing.x);
  ImGui::TextUnformatted(label.c_str());
  compat::push_font(ui.fonts.small);
  const float width = ImGui::CalcTextSize(word.c_str()).x;
  ImGui::SameLine(right - width - 2 * ui.scale);
  ImGui::TextColored(palette::dim, "%s", word.c_str());
  ImGui::PopFont();
  return pressed;
}

bool begin_list(Ui& ui, const char* name, std::size_t lines) {
  const float line = ImGui::GetTextLineHeight() + 4 * ui.scale;
  const float height = line * static_cast<float>(std::clamp<std::size_t>(lines, 1, 8)) + 8 * ui.scale;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::ink);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {6 * ui.scale, 6 * ui.scale});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * ui.scale, 4 * ui.scale});
  return ImGui::BeginChild(name, {0, height}, false,
                           ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollWithMouse);
}

void end_list() {
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

void scenes_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Scenes", "or drop a file")) return;
  ui.scope = "scenes.";
  if (begin_list(ui, "scenes", state.facts.scenes.size())) {
    scroll_list(ui);
    for (const BuiltIn& scene : state.facts.scenes) {
      const bool on = scene.name == state.facts.title;
      if (list_line(ui, scene.name, scene.name, "", on)) state.wishes.open = scene.name;
      tooltip(ui, scene.title);
    }
  }
  end_list();
  ui.scope.clear();
}

void draw_column(Ui& ui, PanelState& state, const Rect& column) {
  if (column.width() <= 0 || column.height() <= 0) return;
  const auto lines = static_cast<float>(accuracy_lines(*state.facts.accuracy).size());
  const float chart = 150 * ui.scale, foot = chart + 80 * ui.scale + lines * line_of_note_height(ui);
  const bool fixed_chart = column.height() > 2.2f * foot;
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
  const float body = column.height() - (fixed_chart ? foot : 0.0f);
  ImGui::SetNextWindowPos({column.x0, column.y0});
  ImGui::SetNextWindowSize({column.width(), body});
  const bool other = state.shown != state.selected && !state.selected.empty() && state.objects.shown != state.selected;
  state.shown = state.selected;
  if (ImGui::Begin("##column", nullptr, flags | ImGuiWindowFlags_NoScrollWithMouse)) {
    if (other) ImGui::SetScrollY(0);  // selected in the picture: its values are at the top
    object_panel(ui, state);
    camera_panel(ui, state);
    image_panel(ui, state);
    histogram_section(ui, state.histogram, state.facts.frame.get(), state.scene.display);
    render_panel(ui, state);
    if (!fixed_chart) chart_panel(ui, state, chart);
    background_panel(ui, state);
    objects_panel(ui, state);
    scenes_panel(ui, state);
    scroll_column(ui);
  }
  ImGui::End();
  if (!fixed_chart) return;
  ImGui::SetNextWindowPos({column.x0, column.y0 + body});
  ImGui::SetNextWindowSize({column.width(), foot});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {16 * ui.scale, 2 * ui.scale});
  if (ImGui::Begin("##chart", nullptr, flags | ImGuiWindowFlags_NoScrollbar)) chart_panel(ui, state, chart);
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace tyndall

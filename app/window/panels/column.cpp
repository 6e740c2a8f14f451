#include "app/window/panels/panels.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr Section sections[] = {
    {"Object", "", "properties, selected object", has_tab | of_scene, object_panel},
    {"Camera", "Camera", "camera settings", has_tab | of_scene, camera_panel},
    {"Image", "Image", "image settings", has_tab, image_panel},
    {"Histogram", "Histogram", "levels, clipping", starts_folded, histogram_panel},
    {"Film", "Film", "", of_scene, film_panel},
    {"Render", "Render", "render settings", has_tab | of_scene, render_panel},
    {"Accuracy", "Speed and accuracy", "chart, statistics, graph", has_tab, chart_panel},
    {"Background", "Background", "", of_scene, background_panel},
    {"Objects", "Objects", "outliner, hierarchy, object list, tree", has_tab | of_scene, objects_panel},
    {"Scenes", "Scenes", "examples, recent files, gallery", has_tab, scenes_panel},
    {"Window", "Window", "", 0, window_panel}};

bool is_shown(const PanelState& state, const Section& one) { return state.now.has_scene || !one.is(of_scene); }

/// The row of tabs, and a button for all actions.
void draw_tabs(Ui& ui, PanelState& state) {
  const float s = ui.scale, space = 2 * s;
  const WithFont small(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2 * s, 4 * s});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {space, space});
  const auto has = [&state](const Section& one) { return one.is(has_tab) && is_shown(state, one); };
  float text_width = ImGui::CalcTextSize("...").x;
  float count = 0;
  for (const Section& one : sections)
    if (has(one)) text_width += ImGui::CalcTextSize(one.name).x, ++count;
  const float room = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX() - count * space;
  const float spare = std::max(0.0f, std::floor((room - text_width) / (count + 1)));
  for (const Section& one : sections) {
    if (!has(one)) continue;
    const auto number = static_cast<int>(&one - sections);
    const bool lit = number == state.tabs.lit;
    ImGui::PushStyleColor(ImGuiCol_Button, lit ? palette::chosen : palette::panel);
    ImGui::PushStyleColor(ImGuiCol_Text, lit ? palette::text : palette::dim);
    if (ImGui::Button(one.name, {ImGui::CalcTextSize(one.name).x + spare, 0})) state.tabs.jump = number;
    ImGui::PopStyleColor(2);
    log_item(ui, std::string("tab.") + one.name, lit ? "on" : "off");
    ImGui::SameLine();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, palette::dim);
  if (ImGui::Button("...", {ImGui::CalcTextSize("...").x + spare, 0})) ui.requests.push_back({"all actions by name"});
  ImGui::PopStyleColor();
  log_item(ui, "tab.actions", "button");
  ImGui::PopStyleVar(2);
  tooltip(ui, "all actions and their keys: Ctrl + K");
}

/// Opens the section that the column is to go to.
void begin_jump(Ui& ui, PanelState& state) {
  ColumnTabs& to = state.tabs;
  to.moves = to.jump >= 0;
  if (!to.moves) return;
  to.lit = to.jump;
  to.jump = -1;
  to.sent = -1;
  const std::string heading = sections[to.lit].heading;
  ui.folded.erase(heading.empty() ? title_of(*state.scene, state.selected) : heading);
  ui.wake_in = 0;
}

/// Draws the sections; scrolls to the one that the column is sent to, and finds out which one with a tab is at its
/// head.
void draw_sections(Ui& ui, PanelState& state, bool with_chart) {
  ColumnTabs& to = state.tabs;
  const float scroll = ImGui::GetScrollY(), pad = 14 * ui.scale;
  const bool seeks = ui.sought.drawing >= 0;
  to.sent = seeks ? -1 : !to.moves && to.sent < 0 ? scroll : to.sent;
  const bool scrolled = !to.moves && !seeks && std::abs(scroll - to.sent) > 1;
  for (const Section& one : sections) {
    if (!is_shown(state, one) || (one.draw == chart_panel && !with_chart)) continue;
    const float y = ImGui::GetCursorPosY();
    const auto number = static_cast<int>(&one - sections);
    if (one.is(has_tab)) {
      if (seeks && ui.sought.place.part == one.name) to.lit = number;
      if (to.moves && number == to.lit) ImGui::SetScrollY(std::max(0.0f, y - pad));
      if (scrolled && (number == 0 || y <= scroll + 3 * pad)) to.lit = number;
    }
    ui.drawn = {one.name, ""};
    one.draw(ui, state);
  }
  ui.drawn = {};
}

/// The left edge of the column: dragging it makes the column wider.
void draw_edge(Ui& ui, PanelState& state, const Rect& column) {
  const float reach = 4 * ui.scale;
  const auto handle = [&] {
    ImGui::InvisibleButton("edge", {2 * reach, std::max(1.0f, column.height())});
    log_item(ui, "column.edge", "edge");
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 1)) {
      const float wanted = std::round((column.x1 - ImGui::GetIO().MousePos.x) / ui.scale);
      state.look->column = std::clamp(wanted, narrowest_column, widest_column);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) state.look->column = column_width;
  };
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  draw_part(ui, "##edge", {column.x0 - reach, column.y0, column.x0 + reach, column.y1},
            ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse, {0, 0},
            handle);
  ImGui::PopStyleVar();
}

void draw_shown_column(Ui& ui, PanelState& state, const Rect& column) {
  if (column.width() <= 0 || column.height() <= 0) return;
  const float s = ui.scale, chart = chart_height * s, head = 34 * s;
  const bool has_tabs = column.height() > 8 * head;
  const auto lines = static_cast<float>(accuracy_lines(*state.now.accuracy).size());
  const bool folded = ui.folded.contains("Speed and accuracy");
  const float foot = folded ? 40 * s : chart + 80 * s + lines * line_of_note_height(ui);
  const bool fixed_chart = column.height() > 2.2f * (chart + 80 * s + lines * line_of_note_height(ui));
  Rect body = column;
  if (has_tabs) body.y0 += head;
  if (fixed_chart) body.y1 -= foot;
  if (has_tabs)
    draw_part(ui, "##tabs", {column.x0, column.y0, column.x1, body.y0}, stays_behind | ImGuiWindowFlags_NoScrollbar,
              {12 * s, 8 * s}, [&] { draw_tabs(ui, state); });
  const bool other = state.shown != state.selected && !state.selected.empty() && state.objects.shown != state.selected;
  state.shown = state.selected;
  if (other) state.tabs.jump = 0;  // selected in the picture: its values are shown
  begin_jump(ui, state);
  const auto draw_body = [&] {
    draw_sections(ui, state, !fixed_chart);
    scroll_column(ui);
  };
  draw_part(ui, "##column", body, stays_behind | ImGuiWindowFlags_NoScrollWithMouse, ImGui::GetStyle().WindowPadding,
            draw_body);
  if (fixed_chart)
    draw_part(ui, "##chart", {column.x0, body.y1, column.x1, column.y1}, stays_behind | ImGuiWindowFlags_NoScrollbar,
              {16 * s, 2 * s}, [&] { chart_panel(ui, state); });
  draw_edge(ui, state, column);
}

}  // namespace

std::span<const Section> column_sections() { return sections; }

int section_named(std::string_view name) {
  const auto found =
      std::find_if(std::begin(sections), std::end(sections), [&](const Section& one) { return one.name == name; });
  return static_cast<int>(found - std::begin(sections));
}

std::vector<RowEntry> rows_of_column(const Ui& ui, const PanelState& state) {
  std::vector<RowEntry> rows;
  Ui beside = ui;  // neither the column nor the log knows of what is drawn here
  PanelState shown = state;
  beside.log = nullptr;
  beside.rows = &rows;
  beside.folded.clear();
  beside.sought = {};
  beside.edit = {};
  constexpr ImGuiWindowFlags unseen = stays_behind | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing;
  draw_part(beside, "##rows", {-9400, -9400, -9000, -9000}, unseen, {0, 0}, [&] {
    for (const Section& one : sections) {
      beside.drawn = {one.name, ""};
      one.draw(beside, shown);
    }
  });
  return rows;
}

void draw_column(Ui& ui, PanelState& state, const Rect& column) {
  ui.drag.active = false;
  draw_shown_column(ui, state, column);
  go_on_seeking(ui);
  ui.drag.cancel = ui.close_popup = false;
}

}  // namespace tyndall

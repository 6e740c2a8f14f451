#include "app/window/panels/list_rows.h"
#include "app/window/panels/panels.h"
#include "app/window/panels/wheel.h"
#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr std::size_t searched = 9;       // lists of at least so many objects can be searched
constexpr std::size_t max_unfolded = 20;  // larger groups are folded at first

struct ObjectLine {
  ObjectPath path;
  std::string label, note;
  bool group = false, open = false;
};

bool is_open(const ObjectsView& view, const ObjectPath& path, std::size_t size) {
  return (size <= max_unfolded) != view.toggled.contains(path);
}

/// The lines that are shown: what is in folded groups is left out; while a text is searched for, only what holds it is
/// shown, wherever it is.
void add_lines(const PanelState& state, const std::vector<Object>& objects, ObjectPath& path,
               std::vector<ObjectLine>& out) {
  const std::string wanted = lower_case(state.objects.search);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    path.push_back(static_cast<int>(i));
    const Material* material = material_of(state.scene, objects[i]);
    const Group* group = std::get_if<Group>(&objects[i].kind);
    ObjectLine line{path, title_of(state.scene, path), material ? material->name : kind_name(objects[i]),
                    group != nullptr,
                    group && (!wanted.empty() || is_open(state.objects, path, group->objects.size()))};
    if (group) line.note = std::to_string(group->objects.size()) + " in " + line.note;
    const bool found = wanted.empty() || lower_case(line.label + " " + line.note).find(wanted) != std::string::npos;
    const bool open = line.open;
    if (found) out.push_back(std::move(line));
    if (open) add_lines(state, group->objects, path, out);
    path.pop_back();
  }
}

/// Opens the groups around an object, so that its line can be seen.
void unfold_around(PanelState& state, const ObjectPath& path) {
  ObjectPath group;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    group.push_back(path[k]);
    const auto size = std::get<Group>(find_object(state.scene, group)->kind).objects.size();
    if (is_open(state.objects, group, size)) continue;
    if (!state.objects.toggled.erase(group)) state.objects.toggled.insert(group);
  }
}

/// A click in the list: selects, with Ctrl as well, or deselects.
void choose(PanelState& state, const ObjectPath& path, bool on) {
  const bool more = ImGui::GetIO().KeyCtrl && !state.selected.empty();
  const auto had = std::find(state.also.begin(), state.also.end(), path);
  if (more && had != state.also.end()) {
    state.also.erase(had);
  } else if (more && path != state.selected) {
    state.also.insert(state.also.begin(), state.selected);
    state.selected = path;
  } else {
    state.also.clear();
    state.selected = on ? ObjectPath{} : path;
  }
  state.objects.shown = state.selected;  // the list stays where the mouse is
}

void draw_line(Ui& ui, PanelState& state, const ObjectLine& line, std::size_t number) {
  const bool also = std::find(state.also.begin(), state.also.end(), line.path) != state.also.end();
  const bool on = line.path == state.selected || also;
  const std::string fold = line.group ? (line.open ? "- " : "+ ") : "";
  const std::string label = std::string(2 * (line.path.size() - 1), ' ') + fold + line.label;
  const float left = ImGui::GetCursorScreenPos().x;
  if (!list_line(ui, std::to_string(number), label, line.note, on)) return;
  const bool on_sign = ImGui::GetIO().MousePos.x <
                       left + ImGui::CalcTextSize(label.substr(0, label.size() - line.label.size()).c_str()).x;
  if (line.group && on_sign) {
    if (!state.objects.toggled.erase(line.path)) state.objects.toggled.insert(line.path);
  } else {
    choose(state, line.path, on && !also);
  }
}

/// Scrolls to the line of the selected object if it was selected elsewhere. line: the height of one.
void follow_selection(PanelState& state, const std::vector<ObjectLine>& lines, float line) {
  if (state.objects.shown == state.selected) return;
  state.objects.shown = state.selected;
  const auto at =
      std::find_if(lines.begin(), lines.end(), [&](const ObjectLine& l) { return l.path == state.selected; });
  if (at == lines.end()) return;
  const float top = line * static_cast<float>(at - lines.begin()), height = ImGui::GetWindowHeight();
  if (top < ImGui::GetScrollY() || top + line > ImGui::GetScrollY() + height) ImGui::SetScrollY(top - height / 2);
}

void search_row(Ui& ui, PanelState& state) {
  char text[64] = {};
  state.objects.search.copy(text, sizeof text - 1);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##search", "search by name, kind or material", text, sizeof text))
    state.objects.search = text;
  log_item(ui, "search", state.objects.search);
}

}  // namespace

void objects_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Objects", "click in the picture, or here")) return;
  ui.scope = "objects.";
  if (state.objects.shown != state.selected) unfold_around(state, state.selected);
  std::vector<ObjectLine> lines;
  ObjectPath path;
  add_lines(state, state.scene.objects, path, lines);
  const bool searches = leaves(state.scene).size() >= searched || !state.objects.search.empty();
  if (searches) search_row(ui, state);
  const float line = ImGui::GetTextLineHeight() + 4 * ui.scale;
  if (begin_list(ui, "objects", line, searches ? searched : lines.size(), 8)) {
    follow_selection(state, lines, line);
    scroll_list(ui);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(lines.size()), line);
    while (clipper.Step())
      for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k)
        draw_line(ui, state, lines[static_cast<std::size_t>(k)], static_cast<std::size_t>(k));
  }
  end_list();
  ui.scope.clear();
}

}  // namespace tyndall

#include "app/window/panels/panels.h"
#include "app/window/system/imgui_compat.h"
#include "core/base/text.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr double pause = 0.5;  // seconds without the wheel after which it is a new movement

void scroll(Ui& ui, ImGuiID id, float notches) {
  ui.wheel = {id, ImGui::GetTime()};
  const float step = std::min(5 * ImGui::GetFontSize(), 0.67f * ImGui::GetWindowHeight());
  ImGui::SetScrollY(std::clamp(ImGui::GetScrollY() - notches * step, 0.0f, ImGui::GetScrollMaxY()));
}

void scroll_list(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiID id = ImGui::GetID("wheel");
  // Whether a movement of the wheel that another window has is still going on.
  const bool of_other = ui.wheel.owner != id && ui.wheel.owner != 0 && ImGui::GetTime() < ui.wheel.last + pause;
  if (io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered() || of_other) return;
  const bool at_end = io.MouseWheel > 0 ? ImGui::GetScrollY() <= 0 : ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
  if (at_end) return;
  scroll(ui, id, io.MouseWheel);
  ui.wheel.used = true;
}

/// A line of a list, with a grey word on the right. Returns whether it was clicked.
bool list_line(Ui& ui, const std::string& name, const std::string& label, const std::string& note, bool on) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  const bool pressed = ImGui::Selectable(("##" + name).c_str(), on, 0, {0, ImGui::GetTextLineHeight()});
  log_item(ui, name, on ? "on" : "off");
  compat::push_font(ui.fonts.small);
  const float width = std::min(ImGui::CalcTextSize(note.c_str()).x, 0.45f * (right - at.x));
  clipped_text_at(note, {right - width - 2 * ui.scale, at.y + 2 * ui.scale}, width + 1, palette::dim);
  ImGui::PopFont();
  clipped_text_at(label, {at.x, at.y}, right - width - 10 * ui.scale - at.x, palette::text);
  return pressed;
}

/// A list of so many lines, `shown` of them seen at a time: when the mouse is over it, the wheel scrolls it, unless the
/// column was being scrolled a moment ago, or the list is at its end. line: the height of one, in window units; draw:
/// draws a line by its number, and is called for those that are seen; before: called within the list's window first.
void list(Ui& ui, const char* name, float line, std::size_t lines, std::size_t shown,
          const std::function<void(std::size_t)>& draw, const std::function<void()>& before = {}) {
  const float height = line * static_cast<float>(std::max<std::size_t>(shown, 1)) + 8 * ui.scale;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::ink);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {6 * ui.scale, 6 * ui.scale});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * ui.scale, 4 * ui.scale});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollWithMouse;
  if (ImGui::BeginChild(name, {0, height}, false, flags)) {
    if (before) before();
    scroll_list(ui);
    ImGuiListClipper clipper;  // lines that are not seen cost nothing
    clipper.Begin(static_cast<int>(lines), line);
    while (clipper.Step())
      for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) draw(static_cast<std::size_t>(k));
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

constexpr std::size_t searched = 9;       // lists of at least so many objects can be searched
constexpr std::size_t max_unfolded = 20;  // larger groups are folded at first

struct ObjectLine {
  ObjectPath path;
  std::string label, note;
  std::string sign;  ///< of a group, which a click on it folds or unfolds
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
    const Material* material = material_of(*state.scene, objects[i]);
    const Group* group = std::get_if<Group>(&objects[i].kind);
    const bool open = group && (!wanted.empty() || is_open(state.objects, path, group->objects.size()));
    ObjectLine line{path, title_of(*state.scene, path), material ? material->name : kind_name(objects[i]),
                    group ? (open ? "- " : "+ ") : ""};
    if (group) line.note = std::to_string(group->objects.size()) + " in " + line.note;
    const bool found = wanted.empty() || lower_case(line.label + " " + line.note).find(wanted) != std::string::npos;
    if (found) out.push_back(std::move(line));
    if (open) add_lines(state, group->objects, path, out);
    path.pop_back();
  }
}

/// Folds a group that is open, and opens one that is folded.
void toggle(ObjectsView& view, const ObjectPath& group) {
  if (!view.toggled.erase(group)) view.toggled.insert(group);
}

void draw_line(Ui& ui, PanelState& state, const ObjectLine& line, std::size_t number) {
  const bool also = std::find(state.also.begin(), state.also.end(), line.path) != state.also.end();
  const bool on = line.path == state.selected || also;
  const std::string before = std::string(2 * (line.path.size() - 1), ' ') + line.sign;
  const float left = ImGui::GetCursorScreenPos().x;
  if (!list_line(ui, std::to_string(number), before + line.label, line.note, on)) return;
  const bool on_sign = ImGui::GetIO().MousePos.x < left + ImGui::CalcTextSize(before.c_str()).x;
  if (!line.sign.empty() && on_sign) return toggle(state.objects, line.path);
  // Selects, with Ctrl as well, or deselects.
  if (ImGui::GetIO().KeyCtrl && !state.selected.empty() && line.path != state.selected) {
    if (std::erase(state.also, line.path) == 0)
      state.also.insert(state.also.begin(), std::exchange(state.selected, line.path));
  } else {
    state.also.clear();
    state.selected = on && !also ? ObjectPath{} : line.path;
  }
  state.objects.shown = state.selected;  // the list stays where the mouse is
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

constexpr float row_height = 46, picture_width = 64, picture_height = 40;  // units of the design

/// A scene that can be opened.
struct SceneRow {
  std::string name;     ///< in the log
  std::string what;     ///< what load_scene takes
  std::string label;    ///< its first line
  std::string line;     ///< its second one
  std::string details;  ///< tooltip
};

/// "Fails: ..." as far as a scene's file says it before "Right: ..."; "" if it does not say it.
std::string failure_in(const std::string& about) {
  const std::size_t at = about.find("Fails:");
  if (at == std::string::npos) return "";
  const std::string text = about.substr(at, about.find("Right:", at) - at);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// Picture, name and a grey line. Returns whether it was clicked.
bool scene_row(Ui& ui, PanelState& state, const SceneRow& row) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float s = ui.scale, right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  const bool on = row.what == state.now.what;
  const ImVec2 size{0, row_height * s - ImGui::GetStyle().ItemSpacing.y};
  const bool pressed = ImGui::Selectable(("##" + row.name).c_str(), on, 0, size);
  log_item(ui, row.name, on ? "on" : "off");
  tooltip(ui, row.details);
  const Rect place{at.x, at.y, at.x + picture_width * s, at.y + picture_height * s};
  ImGui::GetWindowDrawList()->AddRectFilled(at, {place.x1, place.y1}, shade(palette::field), 3 * s);
  if (const auto& all = state.now.pictures; all && all->contains(row.what) && all->at(row.what))
    draw_fitted(*all->at(row.what), place, 3 * s);
  state.wanted_pictures.push_back(row.what);
  const float left = at.x + (picture_width + 10) * s;
  clipped_text_at(row.label, {left, at.y + 2 * s}, right - left, palette::text);
  const WithFont small(ui.fonts.small);
  clipped_text_at(row.line, {left, at.y + 22 * s}, right - left, palette::dim);
  return pressed;
}

std::vector<SceneRow> rows_of(const std::vector<BuiltIn>& scenes) {
  std::vector<SceneRow> rows;
  for (const BuiltIn& scene : scenes) {
    const std::string fails = failure_in(scene.about);
    rows.push_back({scene.name, scene.name, scene.name, fails.empty() ? scene.title : fails,
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

void scene_list(Ui& ui, PanelState& state, const char* name, const std::vector<SceneRow>& rows, std::size_t maximum) {
  list(ui, name, row_height * ui.scale, rows.size(), std::min(rows.size(), maximum), [&](std::size_t k) {
    if (scene_row(ui, state, rows[k])) ui.requests.push_back({"scene", rows[k].what});
  });
}

}  // namespace

void scroll_column(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool used = std::exchange(ui.wheel.used, false);
  if (used || io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) return;
  scroll(ui, ImGui::GetID("wheel"), io.MouseWheel);
}

void objects_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Objects", "click in the picture, or here")) return;
  const Scope scope(ui, "objects");
  const bool elsewhere = state.objects.shown != state.selected;  // then the groups around it open
  for (ObjectPath group = state.selected; elsewhere && group.size() > 1;) {
    group.pop_back();
    const auto size = std::get<Group>(find_object(*state.scene, group)->kind).objects.size();
    if (!is_open(state.objects, group, size)) toggle(state.objects, group);
  }
  std::vector<ObjectLine> lines;
  ObjectPath path;
  add_lines(state, state.scene->objects, path, lines);
  const bool searches = leaves(*state.scene).size() >= searched || !state.objects.search.empty();
  if (searches) {
    char text[64] = {};
    state.objects.search.copy(text, sizeof text - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##search", "search by name, kind or material", text, sizeof text))
      state.objects.search = text;
    log_item(ui, "search", state.objects.search);
  }
  const float line = ImGui::GetTextLineHeight() + 4 * ui.scale;
  list(
      ui, "objects", line, lines.size(), searches ? 8 : std::min<std::size_t>(lines.size(), 8),
      [&](std::size_t k) { draw_line(ui, state, lines[k], k); }, [&] { follow_selection(state, lines, line); });
}

void scenes_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Scenes", "or drop a file")) return;
  const Scope scope(ui, "scenes");
  scene_list(ui, state, "scenes", rows_of(state.now.scenes), 6);
  const std::vector<SceneRow> recent = rows_of(state.now.recent);
  if (!recent.empty()) {
    note(ui, "Opened before", false);
    scene_list(ui, state, "recent", recent, 3);
  }
}

}  // namespace tyndall

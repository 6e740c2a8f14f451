#include "app/window/panels/widgets.h"

#include "core/base/text.h"

#include <algorithm>
#include <cstring>

namespace tyndall {
namespace {

/// The box while the name is typed. Returns whether the name changed.
bool typed_name(Ui& ui, const std::string& hint, float width, std::string& value) {
  TextEdit& edit = ui.edit;
  ImGui::SetNextItemWidth(width);
  if (edit.waited == 0) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextWithHint("##typed", hint.c_str(), edit.text, sizeof edit.text, ImGuiInputTextFlags_AutoSelectAll);
  const bool active = ImGui::IsItemActive();
  edit.started = edit.started || active;
  ++edit.waited;
  // The keyboard reaches it a frame later, and shortcuts lose it a frame after that.
  if (!active || !ImGui::GetIO().WantTextInput) ui.wake_in = 0;
  if (active || (!edit.started && edit.waited < 6)) return false;
  const bool changed = edit.start != edit.text;
  if (changed) value = edit.text;
  edit = {};
  return changed;
}

}  // namespace

bool name_row(Ui& ui, const Row& row, const std::string& hint, bool begin, std::string& value) {
  begin_row(ui, row);
  const ImGuiID id = ImGui::GetID("name");
  const float width = value_width(ui);
  bool changed = false;
  if (ui.edit.id == id) {
    changed = typed_name(ui, hint, width, value);
    log_item(ui, row.name, "typing");
  } else {
    ImGui::InvisibleButton("name", {std::max(width, 1.0f), ImGui::GetFrameHeight()});
    if (ImGui::IsItemClicked() || begin) {
      if (begin) ImGui::SetScrollHereY();
      ui.edit = {};
      ui.edit.id = id;
      ui.edit.start = value.substr(0, size_of_letters(value, sizeof ui.edit.text - 1));
      std::strncpy(ui.edit.text, ui.edit.start.c_str(), sizeof ui.edit.text - 1);
      ui.wake_in = 0;
    }
    const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(a, b, shade(ImGui::IsItemHovered() ? palette::field_hovered : palette::field), 4 * ui.scale);
    draw->PushClipRect(a, b, true);
    draw->AddText({a.x + 8 * ui.scale, a.y + 4 * ui.scale}, shade(value.empty() ? palette::dim : palette::text),
                  printable(value.empty() ? hint : value).c_str());
    draw->PopClipRect();
    log_item(ui, row.name, value);
  }
  end_row(ui, row);
  return changed_if(ui, changed);
}

}  // namespace tyndall

#include "app/window/panels/widgets.h"
#include "app/window/system/imgui_compat.h"
#include "core/base/text.h"

#include <algorithm>

/// Rows of choices: buttons side by side, and lists that drop down.
namespace tyndall {
namespace {

/// The arrow keys go through the choices of a row that the column was sent to.
bool choose_by_keys(Ui& ui, std::span<const Choice> choices, int& chosen) {
  if (!ui.sought.here || !ui.sought.has_keys || ImGui::GetIO().WantTextInput || ui.has_question) return false;
  if (compat::key_pressed(ImGuiKey_Enter)) ui.sought.has_keys = false;
  const bool on = compat::key_pressed(ImGuiKey_RightArrow) || compat::key_pressed(ImGuiKey_DownArrow);
  const bool back = compat::key_pressed(ImGuiKey_LeftArrow) || compat::key_pressed(ImGuiKey_UpArrow);
  const int count = static_cast<int>(choices.size()), step = (on ? 1 : 0) - (back ? 1 : 0);
  for (int k = chosen + step; step != 0 && k >= 0 && k < count; k += step) {
    if (choices[static_cast<std::size_t>(k)].missing) continue;
    chosen = k;
    return true;
  }
  return false;
}

/// A button of a choice. Returns whether it was pressed and so becomes the chosen one.
bool choice_button(Ui& ui, const Row& row, const Choice& choice, bool on, ImVec2 size) {
  ImGui::PushStyleColor(ImGuiCol_Button, on ? palette::chosen : palette::field);
  ImGui::PushStyleColor(ImGuiCol_Text, choice.missing ? palette::faint : palette::text);
  const bool pressed = ImGui::Button(choice.name.c_str(), size);
  ImGui::PopStyleColor(2);
  log_item(ui, row.name + "." + choice.name, on ? "on" : choice.missing ? "missing" : "off");
  tooltip(ui, choice.missing ? choice.missing : choice.help);
  if (pressed && choice.missing) ui.problem = choice.name + ": " + choice.missing;
  return pressed && !on && !choice.missing;
}

}  // namespace

bool choice_row(Ui& ui, const Row& row, std::span<const Choice> choices, int& chosen, int columns) {
  begin_row(ui, row);
  const int count = static_cast<int>(choices.size()), per_line = columns > 0 ? columns : count;
  const float space = 2 * ui.scale, left = ImGui::GetCursorPosX();
  const float width = (value_width(ui) - space * static_cast<float>(per_line - 1)) / static_cast<float>(per_line);
  bool changed = choose_by_keys(ui, choices, chosen);
  const WithFont small(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {space, space});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2 * ui.scale, 2 * ui.scale});
  for (int k = 0; k < count; ++k) {
    if (k % per_line != 0) ImGui::SameLine();
    if (k > 0 && k % per_line == 0) ImGui::SetCursorPosX(left);
    const ImVec2 size{width, ImGui::GetFontSize() + 10 * ui.scale};
    if (choice_button(ui, row, choices[static_cast<std::size_t>(k)], k == chosen, size)) chosen = k, changed = true;
  }
  ImGui::PopStyleVar(2);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetStyle().ItemSpacing.y - space);
  end_row(ui, row);
  return changed;
}

bool combo_row(Ui& ui, const Row& row, std::span<const Choice> choices, int& chosen) {
  begin_row(ui, row);
  ImGui::SetNextItemWidth(value_width(ui));
  bool changed = choose_by_keys(ui, choices, chosen);
  const std::string now = chosen >= 0 ? choices[static_cast<std::size_t>(chosen)].name : "";
  const bool open = ImGui::BeginCombo("##list", now.c_str());
  log_item(ui, row.name, now);
  if (open) {
    for (int k = 0; k < static_cast<int>(choices.size()); ++k) {
      const Choice& choice = choices[static_cast<std::size_t>(k)];
      ImGui::PushID(k);
      const ImGuiSelectableFlags flags = choice.missing ? ImGuiSelectableFlags_Disabled : ImGuiSelectableFlags_None;
      if (ImGui::Selectable(choice.name.c_str(), k == chosen, flags)) changed = k != chosen, chosen = k;
      ImGui::PopID();
      log_item(ui, row.name + "." + choice.name, choice.missing ? "missing" : "item");
      tooltip(ui, choice.missing ? choice.missing : choice.help);
    }
    if (ui.close_popup) ImGui::CloseCurrentPopup();
    ImGui::EndCombo();
  }
  end_row(ui, row);
  return changed;
}

bool name_row(Ui& ui, const Row& row, const std::string& hint, bool begin, std::string& value) {
  begin_row(ui, row);
  const ImGuiID id = ImGui::GetID("name");
  const float width = value_width(ui);
  bool changed = false;
  if (ui.edit.id == id) {
    const bool ended = type_text(ui, hint.c_str(), width);
    changed = ended && ui.edit.start != ui.edit.text;
    if (changed) value = ui.edit.text;
    if (ended) ui.edit = {};
    log_item(ui, row.name, "typing");
  } else {
    ImGui::InvisibleButton("name", {std::max(width, 1.0f), ImGui::GetFrameHeight()});
    if (ImGui::IsItemClicked() || begin) {
      if (begin) ImGui::SetScrollHereY();
      begin_typing(ui, id, value);
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
  return changed;
}

}  // namespace tyndall

#include "app/window/panels/list_rows.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>

namespace tyndall {

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

bool begin_list(Ui& ui, const char* name, float line, std::size_t lines, std::size_t maximum) {
  const float height = line * static_cast<float>(std::clamp<std::size_t>(lines, 1, maximum)) + 8 * ui.scale;
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

}  // namespace tyndall

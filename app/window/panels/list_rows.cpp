#include "app/window/panels/list_rows.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr double pause = 0.5;  // seconds without the wheel after which it is a new movement

/// Whether a movement of the wheel that another window has is still going on.
bool belongs_to_other(const Ui& ui, ImGuiID id) {
  return ui.wheel.owner != id && ui.wheel.owner != 0 && ImGui::GetTime() < ui.wheel.last + pause;
}

void scroll(Ui& ui, ImGuiID id, float notches) {
  ui.wheel = {id, ImGui::GetTime(), true};
  const float step = std::min(5 * ImGui::GetFontSize(), 0.67f * ImGui::GetWindowHeight());
  ImGui::SetScrollY(std::clamp(ImGui::GetScrollY() - notches * step, 0.0f, ImGui::GetScrollMaxY()));
}

void scroll_list(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiID id = ImGui::GetID("wheel");
  if (io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered() || belongs_to_other(ui, id)) return;
  const bool at_end = io.MouseWheel > 0 ? ImGui::GetScrollY() <= 0 : ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
  if (!at_end) scroll(ui, id, io.MouseWheel);
}

}  // namespace

void scroll_column(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool used = ui.wheel.used;
  ui.wheel.used = false;
  if (used || io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) return;
  scroll(ui, ImGui::GetID("wheel"), io.MouseWheel);
  ui.wheel.used = false;
}

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

void list(Ui& ui, const char* name, float line, std::size_t lines, std::size_t shown,
          const std::function<void(std::size_t)>& draw, const std::function<void()>& before) {
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

}  // namespace tyndall

#include "app/window/panels/wheel.h"

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

}  // namespace

void scroll_list(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const ImGuiID id = ImGui::GetID("wheel");
  if (io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered() || belongs_to_other(ui, id)) return;
  const bool at_end = io.MouseWheel > 0 ? ImGui::GetScrollY() <= 0 : ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
  if (!at_end) scroll(ui, id, io.MouseWheel);
}

void scroll_column(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool used = ui.wheel.used;
  ui.wheel.used = false;
  if (used || io.MouseWheel == 0 || io.KeyCtrl || !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) return;
  scroll(ui, ImGui::GetID("wheel"), io.MouseWheel);
  ui.wheel.used = false;
}

}  // namespace tyndall

#include "app/window/menus/menu.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr int key_enter = 257, key_down = 264, key_up = 265;  // GLFW's numbers

constexpr ImGuiWindowFlags menu_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoNav;

/// A line of the menu; returns whether it was clicked.
bool menu_line(Ui& ui, const MenuItem& item, bool marked, float width) {
  const bool can = item.why_not.empty();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::Selectable(("##" + item.name).c_str(), marked, 0, {width, ImGui::GetTextLineHeight()});
  log_item(ui, item.name, can ? "item" : "missing");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddText(at, shade(can ? palette::text : palette::dim, can ? 1.0f : 0.6f), item.label.c_str());
  compat::push_font(ui.fonts.small);
  const float key_width = ImGui::CalcTextSize(item.key.c_str()).x;
  draw->AddText({at.x + width - key_width, at.y + 2 * ui.scale}, shade(palette::dim), item.key.c_str());
  ImGui::PopFont();
  tooltip(ui, item.why_not);
  return pressed && can;
}

}  // namespace

void Menu::open(float x, float y, std::string title, std::vector<MenuItem> items) {
  items_ = std::move(items), title_ = std::move(title);
  x_ = x, y_ = y;
  mark_ = chosen_ = -1;
  fresh_ = true;
}

void Menu::move_mark(int by) {
  const int count = static_cast<int>(items_.size());
  const int from = mark_ < 0 ? (by > 0 ? -1 : count) : mark_;
  for (int step = 1; step <= count; ++step) {
    mark_ = ((from + by * step) % count + count) % count;
    if (items_[static_cast<std::size_t>(mark_)].why_not.empty()) return;
  }
}

bool Menu::take_key(int key) {
  if (!is_open() || (key != key_up && key != key_down && key != key_enter)) return false;
  if (key == key_enter)
    chosen_ = mark_;
  else
    move_mark(key == key_down ? 1 : -1);
  return true;
}

std::optional<Request> Menu::draw(Ui& ui, const Rect& area) {
  if (!is_open()) return {};
  const float s = ui.scale, pad = 10 * s, line = ImGui::GetTextLineHeight() + 6 * s;
  float width = 120 * s;
  for (const MenuItem& item : items_)
    width = std::max(width, ImGui::CalcTextSize((item.label + "    " + item.key).c_str()).x);
  const auto separators =
      static_cast<float>(std::count_if(items_.begin(), items_.end(), [](auto& i) { return i.separated; }));
  const float height = line * (static_cast<float>(items_.size()) + 1) + 6 * s * separators + 2 * pad;
  const float x = std::clamp(x_, area.x0, std::max(area.x0, area.x1 - width - 2 * pad));
  const float y = std::clamp(y_, area.y0, std::max(area.y0, area.y1 - height));
  ImGui::SetNextWindowPos({x, y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * s, 6 * s});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::field);
  ImGui::Begin("##menu", nullptr, menu_flags);
  if (fresh_) ImGui::SetWindowFocus();
  ImGui::TextColored(palette::dim, "%s", title_.c_str());
  const int by_key = std::exchange(chosen_, -1);
  std::optional<Request> chosen;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    if (items_[k].separated) ImGui::Separator();
    const int number = static_cast<int>(k);
    if (menu_line(ui, items_[k], number == mark_, width) || number == by_key) chosen = items_[k].request;
  }
  const bool pressed = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize(), mouse = ImGui::GetIO().MousePos;
  const bool beside =
      pressed && !fresh_ && !Rect{from.x, from.y, from.x + size.x, from.y + size.y}.contains(mouse.x, mouse.y);
  fresh_ = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  if (chosen || beside) close();
  return chosen;
}

}  // namespace tyndall

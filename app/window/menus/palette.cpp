#include "app/window/menus/palette.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace tyndall {
namespace {

constexpr int key_down_arrow = 264, key_up_arrow = 265;  // GLFW's numbers
constexpr int most_lines = 12;

constexpr ImGuiWindowFlags palette_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// A line of the palette; returns whether it was clicked.
bool palette_line(Ui& ui, const PaletteItem& item, bool marked, bool scroll) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX();
  const bool pressed = ImGui::Selectable(("##" + item.label).c_str(), marked, 0, {0, ImGui::GetTextLineHeight()});
  log_item(ui, "palette." + item.label, marked ? "on" : "off");
  if (marked && scroll) ImGui::SetScrollHereY();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddText(at, shade(palette::text), item.label.c_str());
  compat::push_font(ui.fonts.small);
  const float key_width = ImGui::CalcTextSize(item.key.c_str()).x;
  draw->AddText({at.x + width - key_width, at.y + 2 * ui.scale}, shade(palette::dim), item.key.c_str());
  ImGui::PopFont();
  return pressed;
}

}  // namespace

std::vector<int> matching_items(const std::vector<PaletteItem>& items, const std::string& text) {
  const std::string wanted = lower(text);
  const auto holds_all = [&](const std::string& where) {
    std::istringstream words(wanted);
    bool all = true;
    for (std::string word; words >> word;) all = all && where.find(word) != std::string::npos;
    return all;
  };
  std::vector<int> ranked[3];  // the label begins with the text, holds all words, does so with the other words
  for (std::size_t k = 0; k < items.size(); ++k) {
    const std::string label = lower(items[k].label);
    const int rank = !wanted.empty() && label.starts_with(wanted)    ? 0
                     : holds_all(label)                              ? 1
                     : holds_all(label + " " + lower(items[k].also)) ? 2
                                                                     : -1;
    if (rank >= 0) ranked[rank].push_back(static_cast<int>(k));
  }
  for (const auto& next : {ranked[1], ranked[2]}) ranked[0].insert(ranked[0].end(), next.begin(), next.end());
  return ranked[0];
}

void Palette::open(std::vector<PaletteItem> items) {
  items_ = std::move(items);
  text_[0] = '\0';
  mark_ = 0;
  fresh_ = true;
}

bool Palette::take_key(int key) {
  if (!is_open() || (key != key_down_arrow && key != key_up_arrow)) return false;
  mark_ += key == key_down_arrow ? 1 : -1;
  moved_ = true;
  return true;
}

int Palette::draw(Ui& ui, const Rect& area) {
  if (!is_open()) return -1;
  const float s = ui.scale, line = ImGui::GetTextLineHeight() + 6 * s, width = std::min(460 * s, area.width() - 20 * s);
  const std::string before = text_;
  const ImVec2 from{(area.x0 + area.x1 - width) / 2, area.y0 + std::min(60 * s, area.height() / 8)};
  ImGui::SetNextWindowPos(from);
  ImGui::SetNextWindowSize({width, 28 * s + ImGui::GetFrameHeight() + line * most_lines});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * s, 6 * s});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::panel);
  ImGui::Begin("##palette", nullptr, palette_flags);
  if (fresh_) ImGui::SetWindowFocus(), ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool enter = ImGui::InputTextWithHint("##text", "what to do: type a part of its name", text_, sizeof text_,
                                              ImGuiInputTextFlags_EnterReturnsTrue);
  log_item(ui, "palette", text_);
  if (before != text_) mark_ = 0;
  const std::vector<int> found = matching_items(items_, text_);
  mark_ = std::clamp(mark_, 0, std::max(0, static_cast<int>(found.size()) - 1));
  int chosen = -1;
  ImGui::BeginChild("##lines");
  for (std::size_t k = 0; k < found.size(); ++k) {
    const bool marked = static_cast<int>(k) == mark_;
    if (palette_line(ui, items_[static_cast<std::size_t>(found[k])], marked, moved_)) chosen = found[k];
  }
  if (found.empty()) note(ui, "nothing has such a name", false);
  ImGui::EndChild();
  if (enter && !found.empty()) chosen = found[static_cast<std::size_t>(mark_)];
  const ImVec2 size = ImGui::GetWindowSize(), mouse = ImGui::GetIO().MousePos;
  const bool beside = ImGui::IsMouseClicked(0) && !fresh_ &&
                      !Rect{from.x, from.y, from.x + size.x, from.y + size.y}.contains(mouse.x, mouse.y);
  fresh_ = moved_ = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (chosen >= 0 || beside) close();
  return chosen;
}

}  // namespace tyndall

#include "app/window/menus/palette.h"

#include "app/window/system/imgui_compat.h"
#include "core/base/text.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace tyndall {
namespace {

constexpr int key_down_arrow = 264, key_up_arrow = 265;  // GLFW's numbers
constexpr int max_lines = 12;

constexpr ImGuiWindowFlags palette_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

/// The text without spaces and signs.
std::string squeezed(std::string text) {
  std::erase_if(text, [](unsigned char c) { return c < 128 && !std::isalnum(c); });
  return text;
}

bool holds_words(const std::string& where, const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (where.find(word) == std::string::npos) return false;
  return true;
}

/// The parts of a text between commas, squeezed.
std::vector<std::string> phrases_of(const std::string& text) {
  std::vector<std::string> phrases;
  std::istringstream in(text);
  for (std::string phrase; std::getline(in, phrase, ',');) phrases.push_back(squeezed(phrase));
  return phrases;
}

constexpr int ranks = 5;

/// How likely the text, in small letters, means an item: 0 most likely, `ranks` not at all.
int rank_of(const PaletteItem& item, const std::string& text) {
  const std::string label = lower_case(item.label), also = lower_case(item.also), sought = squeezed(text);
  const std::size_t colon = label.find(": ");
  const std::string name = squeezed(label), end = colon == std::string::npos ? name : squeezed(label.substr(colon));
  if (!sought.empty()) {
    const std::vector<std::string> phrases = phrases_of(also);
    if (sought == name || sought == end || std::find(phrases.begin(), phrases.end(), sought) != phrases.end()) return 0;
    if (name.starts_with(sought) || end.starts_with(sought)) return 1;
  }
  if (holds_words(label, text)) return 2;
  if (holds_words(label + " " + also, text)) return 3;
  const bool held = (name + " " + squeezed(also)).find(sought) != std::string::npos;
  return held && !sought.empty() ? 4 : ranks;
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
  std::vector<int> ranked[ranks];
  for (std::size_t k = 0; k < items.size(); ++k)
    if (const int rank = rank_of(items[k], lower_case(text)); rank < ranks) ranked[rank].push_back(static_cast<int>(k));
  std::vector<int> all;
  for (const std::vector<int>& next : ranked) all.insert(all.end(), next.begin(), next.end());
  return all;
}

void Palette::open(std::vector<PaletteItem> items) {
  items_ = std::move(items);
  text_[0] = '\0';
  mark_ = 0;
  fresh_ = true;
  resumes_ = false;
}

bool Palette::take_key(int key) {
  if (!is_open() || (key != key_down_arrow && key != key_up_arrow)) return false;
  mark_ += key == key_down_arrow ? 1 : -1;
  moved_ = true;
  return true;
}

/// The box that is typed into; it has the keyboard as long as the palette is open. Returns whether Enter was pressed.
bool Palette::draw_text(Ui& ui) {
  // Enter and clicks beside the text end typing: it goes on.
  if (fresh_ || !(active_ || ImGui::IsAnyItemActive())) ImGui::SetKeyboardFocusHere();
  const auto to_end = [](ImGuiInputTextCallbackData* text) {
    bool& resumes = *static_cast<bool*>(text->UserData);
    if (!std::exchange(resumes, false)) return 0;
    text->ClearSelection();
    text->CursorPos = text->BufTextLen;
    return 0;
  };
  ImGui::SetNextItemWidth(-1);
  constexpr ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways;
  const bool enter = ImGui::InputTextWithHint("##text", "what to do: type a part of its name", text_, sizeof text_,
                                              flags, to_end, &resumes_);
  if (std::exchange(active_, ImGui::IsItemActive()) && !active_) resumes_ = true;
  if (!active_) ui.wake_in = 0;
  log_item(ui, "palette", text_);
  return enter;
}

std::optional<Request> Palette::draw(Ui& ui, const Rect& area) {
  if (!is_open()) return {};
  const float s = ui.scale, line = ImGui::GetTextLineHeight() + 6 * s, width = std::min(460 * s, area.width() - 20 * s);
  const std::string before = text_;
  const ImVec2 from{(area.x0 + area.x1 - width) / 2, area.y0 + std::min(60 * s, area.height() / 8)};
  ImGui::SetNextWindowPos(from);
  ImGui::SetNextWindowSize({width, 28 * s + ImGui::GetFrameHeight() + line * max_lines});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * s);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * s, 6 * s});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::panel);
  ImGui::Begin("##palette", nullptr, palette_flags);
  if (fresh_) ImGui::SetWindowFocus();
  const bool enter = draw_text(ui);
  if (before != text_) mark_ = 0;
  const std::vector<int> found = matching_items(items_, text_);
  mark_ = std::clamp(mark_, 0, std::max(0, static_cast<int>(found.size()) - 1));
  std::optional<Request> chosen;
  ImGui::BeginChild("##lines");
  for (std::size_t k = 0; k < found.size(); ++k) {
    const bool marked = static_cast<int>(k) == mark_;
    const PaletteItem& item = items_[static_cast<std::size_t>(found[k])];
    if (palette_line(ui, item, marked, moved_) || (enter && marked)) chosen = item.request;
  }
  if (found.empty()) note(ui, "nothing has such a name", false);
  ImGui::EndChild();
  const ImVec2 size = ImGui::GetWindowSize(), mouse = ImGui::GetIO().MousePos;
  const bool beside = ImGui::IsMouseClicked(0) && !fresh_ &&
                      !Rect{from.x, from.y, from.x + size.x, from.y + size.y}.contains(mouse.x, mouse.y);
  fresh_ = moved_ = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (chosen || beside) close();
  return chosen;
}

}  // namespace tyndall

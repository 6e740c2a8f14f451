#include "app/window/menus/menu.h"

#include "app/window/system/imgui_compat.h"
#include "core/base/text.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace tyndall {
namespace {

constexpr int key_enter = 257, key_down = 264, key_up = 265;  // GLFW's numbers

constexpr ImGuiWindowFlags menu_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoNav;

/// Whether the mouse is beside the window that is being drawn.
bool is_mouse_beside() {
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize(), mouse = ImGui::GetIO().MousePos;
  return !Rect{from.x, from.y, from.x + size.x, from.y + size.y}.contains(mouse.x, mouse.y);
}

/// A label on the left, and in small grey letters a key on the right.
void draw_label_and_key(Ui& ui, ImVec2 at, float width, const std::string& label, ImU32 colour,
                        const std::string& key) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddText(at, colour, label.c_str());
  compat::push_font(ui.fonts.small);
  const float key_width = ImGui::CalcTextSize(key.c_str()).x;
  draw->AddText({at.x + width - key_width, at.y + 2 * ui.scale}, shade(palette::dim), key.c_str());
  ImGui::PopFont();
}

/// A line of the menu; returns whether it was clicked.
bool menu_line(Ui& ui, const MenuItem& item, bool marked, float width) {
  const bool can = item.why_not.empty();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::Selectable(("##" + item.command).c_str(), marked, 0, {width, ImGui::GetTextLineHeight()});
  log_item(ui, "menu." + item.command, can ? "item" : "missing");
  const ImU32 colour = shade(can ? palette::text : palette::dim, can ? 1.0f : 0.6f);
  draw_label_and_key(ui, at, width, item.command, colour, item.key);
  tooltip(ui, item.why_not);
  return pressed && can;
}

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

constexpr int ranks = 5;

/// How likely the text, in small letters, means an item: 0 most likely, `ranks` not at all.
int rank_of(const PaletteItem& item, const std::string& text) {
  const std::string label = lower_case(item.label), also = lower_case(item.also), sought = squeezed(text);
  const std::size_t colon = label.find(": ");
  const std::string name = squeezed(label), end = colon == std::string::npos ? name : squeezed(label.substr(colon));
  if (!sought.empty()) {
    std::istringstream phrases(name + "," + end + "," + also);
    for (std::string phrase; std::getline(phrases, phrase, ',');)
      if (squeezed(phrase) == sought) return 0;
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
  draw_label_and_key(ui, at, width, item.label, shade(palette::text), item.key);
  return pressed;
}

}  // namespace

void Menu::open(float x, float y, std::string title, std::vector<MenuItem> items) {
  items_ = std::move(items), title_ = std::move(title);
  x_ = x, y_ = y;
  mark_ = chosen_ = -1;
  fresh_ = true;
}

bool Menu::take_key(int key) {
  if (!is_open() || (key != key_up && key != key_down && key != key_enter)) return false;
  if (key == key_enter) return chosen_ = mark_, true;
  const int by = key == key_down ? 1 : -1, count = static_cast<int>(items_.size());
  const int from = mark_ < 0 && by < 0 ? count : mark_;
  for (int step = 1; step <= count; ++step) {
    mark_ = ((from + by * step) % count + count) % count;
    if (items_[static_cast<std::size_t>(mark_)].why_not.empty()) break;
  }
  return true;
}

std::optional<Request> Menu::draw(Ui& ui, const Rect& area) {
  if (!is_open()) return {};
  const float s = ui.scale, pad = 10 * s, line = ImGui::GetTextLineHeight() + 6 * s;
  float width = 120 * s;
  for (const MenuItem& item : items_)
    width = std::max(width, ImGui::CalcTextSize((item.command + "    " + item.key).c_str()).x);
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
    if (menu_line(ui, items_[k], number == mark_, width) || number == by_key) chosen = Request{items_[k].command};
  }
  const bool pressed = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
  const bool beside = pressed && !fresh_ && is_mouse_beside();
  fresh_ = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  if (chosen || beside) close();
  return chosen;
}

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
  if (!is_open() || (key != key_down && key != key_up)) return false;
  mark_ += key == key_down ? 1 : -1;
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
  if (!active_ || !ImGui::GetIO().WantTextInput) ui.wake_in = 0;  // shortcuts lose the keyboard a frame later
  log_item(ui, "palette", text_);
  return enter;
}

std::optional<Request> Palette::draw(Ui& ui, const Rect& area) {
  if (!is_open()) return {};
  const float s = ui.scale, line = ImGui::GetTextLineHeight() + 6 * s, width = std::min(460 * s, area.width() - 20 * s);
  const std::string before = text_;
  ImGui::SetNextWindowPos({(area.x0 + area.x1 - width) / 2, area.y0 + std::min(60 * s, area.height() / 8)});
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
  const bool beside = ImGui::IsMouseClicked(0) && !fresh_ && is_mouse_beside();
  fresh_ = moved_ = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (chosen || beside) close();
  return chosen;
}

}  // namespace tyndall

#include "app/window/panels/widgets.h"

#include "core/base/text.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tyndall {
namespace {

constexpr float label_column = 124, box_width = 68, gap = 8;  // units of the design; the first from the window's edge

float right_edge() { return ImGui::GetWindowContentRegionMax().x; }

/// What is done with a row or section that is sought, where it begins.
void meet_sought(Ui& ui, float height_ratio) {
  SoughtRow& sought = ui.sought;
  sought.met = true;
  if (sought.drawing == 0) ui.folded.erase(ui.drawn.label);
  if (sought.drawing == 1) ImGui::SetScrollHereY(height_ratio);
  if (sought.drawing == 2) sought.types = true;
  sought.top = ImGui::GetCursorScreenPos().y;
}

/// The text as one line, cut and with ".." at its end where it does not fit.
std::string clipped(const std::string& whole, float width) {
  std::string text = printable(whole);
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  const char *begin = text.c_str(), *rest = begin;
  const float room = std::max(1.0f, width - ImGui::CalcTextSize("..").x);
  ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), room, 0, begin, begin + text.size(), &rest);
  return text.substr(0, static_cast<std::size_t>(rest - begin)) + "..";
}

void clipped_text(const std::string& text, float width, Tone colour) {
  ImGui::TextColored(colour, "%s", clipped(text, width).c_str());
}

}  // namespace

void seek_row(Ui& ui, const RowPlace& place) { ui.sought = {place, 0}; }

void go_on_seeking(Ui& ui) {
  SoughtRow& sought = ui.sought;
  const bool met = std::exchange(sought.met, false);
  if (ImGui::IsMouseClicked(0)) sought.has_keys = false;
  if (sought.drawing < 0) return;
  if (sought.drawing == 0 && !met) ui.problem = sought.place.label + " is not shown for what is selected";
  sought.drawing = met && sought.drawing < 2 ? sought.drawing + 1 : -1;
  ui.wake_in = 0;
}

bool is_sought(const Ui& ui, const std::string& label) {
  const RowPlace& place = ui.sought.place;
  return !place.part.empty() && place.part == ui.drawn.part && place.label == label;
}

void clipped_text_at(const std::string& text, ImVec2 at, float width, Tone colour) {
  ImGui::GetWindowDrawList()->AddText(at, shade(colour), clipped(text, width).c_str());
}

float value_width(const Ui& ui) { return right_edge() - label_column * ui.scale; }

void log_item(Ui& ui, const std::string& name, const std::string& value) {
  if (!ui.log) return;
  const ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 low = draw->GetClipRectMin(), high = draw->GetClipRectMax();
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  const Rect rect{std::max(a.x, low.x), std::max(a.y, low.y), std::min(b.x, high.x), std::min(b.y, high.y)};
  if (rect.width() > 0 && rect.height() > 0) ui.log->widget(ui.scope + name, rect, value);
}

void tooltip(Ui& ui, const std::string& text) {
  constexpr double delay = 0.5;
  if (text.empty() || !ImGui::IsItemHovered()) return;
  const ImGuiID id = ImGui::GetID(text.c_str());
  if (std::exchange(ui.hovered, id) != id) ui.hovered_since = ImGui::GetTime();
  const double waited = ImGui::GetTime() - ui.hovered_since;
  if (ImGui::IsMouseDown(0)) ui.hovered_since = ImGui::GetTime();
  if (waited < delay) {
    ui.wake_in = std::min(ui.wake_in, delay - waited);
    return;
  }
  // Beside the column or menu and not over it, so that it hides nothing that the hand goes to next.
  const float left = ImGui::GetWindowPos().x - 8 * ui.scale, width = std::min(300 * ui.scale, left - 30 * ui.scale);
  const bool beside = width > 100 * ui.scale;
  if (beside) ImGui::SetNextWindowPos({left, ImGui::GetItemRectMin().y}, ImGuiCond_Always, {1, 0});
  const WithFont small(ui.fonts.small);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(beside ? width : 300 * ui.scale);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void note(Ui& ui, const std::string& text, bool indent, Tone colour) {
  if (text.empty()) return;
  if (indent) ImGui::SetCursorPosX(label_column * ui.scale);
  const WithFont small(ui.fonts.small);
  ImGui::PushTextWrapPos(right_edge());
  ImGui::TextColored(colour, "%s", text.c_str());
  ImGui::PopTextWrapPos();
}

void line_of_note(Ui& ui, const std::string& text, Tone colour) {
  const float top = ImGui::GetCursorPosY();
  const WithFont small(ui.fonts.small);
  clipped_text(text, right_edge() - ImGui::GetCursorPosX(), colour);
  tooltip(ui, text);
  ImGui::SetCursorPosY(top + line_of_note_height(ui));
}

float line_of_note_height(const Ui& ui) { return 19 * ui.scale; }

bool section(Ui& ui, const std::string& name, const std::string& note_text) {
  ui.drawn.label = name;
  ImGui::Dummy({0, 1 * ui.scale});
  if (is_sought(ui, "")) meet_sought(ui, 0);
  const bool looks = ui.sought.drawing == 0 && ui.sought.place.part == ui.drawn.part;
  const bool open = !ui.folded.contains(name) || looks;
  const ImVec2 at = ImGui::GetCursorPos();
  const float height = ImGui::GetTextLineHeight() + 5 * ui.scale;
  ImGui::PushID(name.c_str());
  if (ImGui::InvisibleButton("section", {std::max(1.0f, right_edge() - at.x), height})) {
    if (open)
      ui.folded.insert(name);
    else
      ui.folded.erase(name);
  }
  const bool hovered = ImGui::IsItemHovered();
  log_item(ui, "section." + name, open ? "open" : "folded");
  ImGui::PopID();
  const ImVec2 after = ImGui::GetCursorPos();
  ImGui::SetCursorPos({at.x, at.y + 3 * ui.scale});
  compat::push_font(ui.fonts.strong);
  clipped_text(name, 0.6f * (right_edge() - at.x), open ? palette::text : palette::dim);
  ImGui::PopFont();
  compat::push_font(ui.fonts.small);
  const std::string shown = hovered ? (open ? "fold" : "unfold") : open ? note_text : "…";
  ImGui::SetCursorPos({right_edge() - ImGui::CalcTextSize(shown.c_str()).x, at.y + 5 * ui.scale});
  ImGui::TextColored(palette::dim, "%s", shown.c_str());
  ImGui::PopFont();
  ImGui::SetCursorPos({after.x, after.y - 4 * ui.scale});
  ImGui::Separator();
  return open;
}

void begin_row(Ui& ui, const Row& row) {
  ui.sought.here = is_sought(ui, row.label) && !ui.sought.met;
  if (ui.sought.here) meet_sought(ui, 0.3f);
  if (ui.rows) ui.rows->push_back({ui.drawn.part, row.label, row.words, ui.drawn.label});
  ImGui::PushID(row.name.c_str());
  ImGui::AlignTextToFramePadding();
  clipped_text(row.label, label_column * ui.scale - ImGui::GetCursorPosX() - 4 * ui.scale, palette::text);
  tooltip(ui, row.help);
  ImGui::SameLine(label_column * ui.scale);
}

void end_row(Ui& ui, const Row& row) {
  ImGui::PopID();
  if (std::exchange(ui.sought.types, false)) ui.sought.has_keys = true;  // it has no number
  if (!row.meaning.empty()) {
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 6 * ui.scale);
    note(ui, row.meaning, true, row.warning ? palette::amber : palette::dim);
  }
  if (!std::exchange(ui.sought.here, false) || !ui.sought.has_keys) return;
  // A frame shows that this choice has the keyboard.
  const float s = ui.scale, left = ImGui::GetWindowPos().x;
  const ImVec2 low{left + 8 * s, ui.sought.top - 3 * s};
  const ImVec2 high{left + right_edge() + 4 * s, ImGui::GetCursorScreenPos().y - 3 * s};
  ImGui::GetWindowDrawList()->AddRect(low, high, shade(palette::blue), 4 * s, 0, 1.5f * s);
}

void row_menu(Ui& ui, const Row& row, bool can_vary) {
  if (row.pointer.empty()) return;
  if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(1)) ImGui::OpenPopup("row");
  if (!ImGui::BeginPopup("row")) return;
  const auto item = [&](const char* label, const char* command) {
    if (ImGui::MenuItem(label)) ui.requests.push_back({command, row.pointer});
    log_item(ui, row.name + "." + command, "menu");
  };
  if (can_vary) item("Vary …", "vary");
  item("Key", "key");
  if (ui.close_popup) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

bool slider_row(Ui& ui, const Row& row, double& value) {
  begin_row(ui, row);
  bool changed = slider(ui, row, value, value_width(ui) - (box_width + gap) * ui.scale);
  row_menu(ui, row, true);
  log_item(ui, row.name, format_short(value));
  tooltip(ui, row.help);
  ImGui::SameLine(0, gap * ui.scale);
  changed = value_box(ui, "value", row, value, box_width * ui.scale, true) || changed;
  end_row(ui, row);
  return changed;
}

void file_row(Ui& ui, Row row, const std::string& file) {
  row.help = file;
  begin_row(ui, row);
  clipped_text(file, value_width(ui), palette::dim);
  end_row(ui, row);
}

void draw_fitted(const PictureTexture& picture, const Rect& place, float rounding) {
  const float fit = std::min(place.width() / picture.width(), place.height() / picture.height());
  const float half_x = fit * picture.width() / 2, half_y = fit * picture.height() / 2;
  const float x = (place.x0 + place.x1) / 2, y = (place.y0 + place.y1) / 2;
  const auto texture = (ImTextureID) static_cast<std::intptr_t>(picture.number());  // NOLINT: a pointer before 1.92
  ImGui::GetWindowDrawList()->AddImageRounded(texture, {x - half_x, y - half_y}, {x + half_x, y + half_y}, {0, 0},
                                              {1, 1}, IM_COL32_WHITE, rounding);
}

void draw_part(Ui& ui, const char* name, const Rect& where, ImGuiWindowFlags more, ImVec2 padding,
               const std::function<void()>& draw) {
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings;
  ImGui::SetNextWindowPos({where.x0, where.y0});
  ImGui::SetNextWindowSize({where.width(), where.height()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  if (ImGui::Begin(name, nullptr, flags | more | (ui.has_question ? ImGuiWindowFlags_NoInputs : 0))) draw();
  ImGui::End();
  ImGui::PopStyleVar();
}

void begin_typing(Ui& ui, ImGuiID id, const std::string& text) {
  ui.edit = {.id = id, .start = text.substr(0, size_of_letters(text, sizeof ui.edit.text - 1))};
  std::strncpy(ui.edit.text, ui.edit.start.c_str(), sizeof ui.edit.text - 1);
}

bool type_text(Ui& ui, const char* hint, float width) {
  TextEdit& edit = ui.edit;
  ImGui::SetNextItemWidth(width);
  if (edit.waited == 0) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextWithHint("##typed", hint, edit.text, sizeof edit.text, ImGuiInputTextFlags_AutoSelectAll);
  const bool active = ImGui::IsItemActive();
  edit.started = edit.started || active;
  ++edit.waited;
  // The keyboard reaches it a frame later, and shortcuts lose it a frame after that.
  if (!active || !ImGui::GetIO().WantTextInput) ui.wake_in = 0;
  return !active && (edit.started || edit.waited >= 6);
}

bool popup_is_open() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup); }

bool small_button(Ui& ui, const std::string& name, const std::string& label, float width) {
  const WithFont small(ui.fonts.small);
  const bool pressed = ImGui::Button((label + "##" + name).c_str(), {width, ImGui::GetFontSize() + 10 * ui.scale});
  log_item(ui, name, "button");
  return pressed;
}

}  // namespace tyndall

#include "app/window/overlays.h"

#include "app/window/actions/actions.h"
#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace tyndall {
namespace {

constexpr ImGuiWindowFlags box_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;

/// Begins a box with round corners, in the middle of an area or at its foot.
void begin_box(Ui& ui, const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags more) {
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.97f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * ui.scale);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18 * ui.scale, 14 * ui.scale});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::panel);
  ImGui::Begin(name, nullptr, box_flags | more);
}

void end_box() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

ImVec2 middle(const Rect& area) { return {(area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2}; }

using Decision = std::optional<std::filesystem::path>;

/// Asks before saving destroys something of the document's file.
Decision loss_question(Ui& ui, Dialog& dialog, const Document& document) {
  const std::string& title = document.origin->title;
  const bool comments = dialog.kind == Dialog::Kind::comments;
  ImGui::TextUnformatted((comments ? "Saving " + title + " loses its comments."
                                   : "Another program has changed " + title + " since it was read.")
                             .c_str());
  note(ui, comments ? "Scenes are written in normal form, which has none." : "Saving replaces what it holds now.",
       false);
  const Answer answers[] = {
      {"dialog.save", "Save anyway"}, {"dialog.save_as", "Save as…"}, {"dialog.cancel", "Cancel"}};
  const int answer = draw_answers(ui, dialog, answers);
  if (answer == 0 || answer == 2) dialog.kind = Dialog::Kind::none;
  if (answer == 1) ask_name(dialog, document.origin->file);
  return answer == 0 ? Decision(document.origin->file) : Decision();
}

Decision name_question(Ui& ui, Dialog& dialog) {
  ImGui::TextUnformatted("Save the scene as");
  const bool enter = draw_name_field(ui, dialog, "scene.json");
  const Answer answers[] = {{"dialog.save", "Save"}, {"dialog.cancel", "Cancel"}};
  const int answer = draw_answers(ui, dialog, answers);
  if (answer == 1) dialog.kind = Dialog::Kind::none;
  if ((!enter && answer != 0) || dialog.name[0] == '\0') return {};
  std::filesystem::path file = typed_file(dialog);
  if (file.extension() != ".json") ask_name(dialog, file += ".json");  // a scene file, as its name is to say
  std::error_code ignored;
  const bool exists = std::filesystem::exists(file, ignored);
  dialog.kind = exists ? Dialog::Kind::replace : Dialog::Kind::none;
  dialog.fresh = true, dialog.marked = 1;
  return exists ? Decision() : Decision(file);
}

Decision replace_question(Ui& ui, Dialog& dialog) {
  ImGui::TextUnformatted((std::string(dialog.name) + " exists.").c_str());
  const Answer answers[] = {{"dialog.replace", "Replace it"}, {"dialog.cancel", "Cancel"}};
  const int answer = draw_answers(ui, dialog, answers);
  if (answer >= 0) dialog.kind = Dialog::Kind::none;
  return answer == 0 ? Decision(typed_file(dialog)) : Decision();
}

}  // namespace

void draw_message(Ui& ui, const Rect& area, const Message& message) {
  if (message.text.empty() || area.width() <= 0) return;
  const float s = ui.scale;
  begin_box(ui, "##message", {area.x0 + 14 * s, area.y1 - 14 * s}, {0, 1},
            ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav);
  ImGui::PushTextWrapPos(std::max(120 * s, std::min(640 * s, area.width() - 64 * s)));
  ImGui::PushStyleColor(ImGuiCol_Text, message.error ? palette::amber : palette::text);
  ImGui::TextUnformatted(message.text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  end_box();
}

void draw_help(Ui& ui, bool& open) {
  // Within the window, however small it is: what is too wide is wrapped, and what is too high is scrolled to.
  const float s = ui.scale, margin = 8 * s;
  const ImVec2 room{ImGui::GetIO().DisplaySize.x - 2 * margin, ImGui::GetIO().DisplaySize.y - 2 * margin};
  ImGui::SetNextWindowSizeConstraints({0, 0}, room);
  begin_box(ui, "##help", {margin + room.x / 2, margin + room.y / 2}, {0.5f, 0.5f}, ImGuiWindowFlags_NoNav);
  ImGui::PushTextWrapPos(room.x - 40 * s);
  compat::push_font(ui.fonts.strong);
  ImGui::TextUnformatted("Mouse and keys");
  ImGui::PopFont();
  ImGui::Separator();
  ImGui::Dummy({0, 2 * s});
  for (const HelpLine& line : help_lines()) {
    ImGui::TextUnformatted(line.input.c_str());
    ImGui::SameLine(210 * s);
    ImGui::TextColored(palette::dim, "%s", line.effect.c_str());
  }
  ImGui::PopTextWrapPos();
  const bool outside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (outside && !ImGui::IsWindowAppearing()) open = false;
  if (ui.log) ui.log->changed("help", "open");
  end_box();
}

void draw_outline(Ui& ui, const Rect& image, const std::vector<ImageLine>& lines) {
  if (lines.empty() || image.width() <= 0) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({image.x0, image.y0}, {image.x1, image.y1}, true);
  const auto at = [&](ImagePoint p) {
    // Points far outside would overflow the draw list's arithmetic.
    const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -20.0, 21.0)); };
    return ImVec2{image.x0 + limited(p.x) * image.width(), image.y0 + limited(p.y) * image.height()};
  };
  for (const ImageLine& line : lines) draw->AddLine(at(line.a), at(line.b), shade(palette::blue, 0.95f), 2 * ui.scale);
  draw->PopClipRect();
}

bool draw_name_field(Ui& ui, Dialog& dialog, const char* hint) {
  ImGui::SetNextItemWidth(420 * ui.scale);
  if (dialog.fresh) ImGui::SetKeyboardFocusHere();
  const bool enter =
      ImGui::InputTextWithHint("##name", hint, dialog.name, sizeof dialog.name, ImGuiInputTextFlags_EnterReturnsTrue);
  log_item(ui, "dialog.name", dialog.name);
  return enter;
}

std::filesystem::path typed_file(const Dialog& dialog) {
  const std::string name = dialog.name;
  const char* home = std::getenv("HOME");
  if (!home || !name.starts_with("~/")) return name;
  return std::filesystem::path(home) / name.substr(2);
}

void ask_name(Dialog& dialog, const std::filesystem::path& suggestion) {
  dialog = {Dialog::Kind::save_as, {}, true, 0};
  std::strncpy(dialog.name, suggestion.c_str(), sizeof dialog.name - 1);
}

void begin_dialog(Ui& ui, const Rect& area) {
  begin_box(ui, "##dialog", middle(area), {0.5f, 0.5f}, 0);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
}

void end_dialog() { end_box(); }

int draw_answers(Ui& ui, Dialog& dialog, std::span<const Answer> answers) {
  const ImGuiIO& io = ImGui::GetIO();
  const int count = static_cast<int>(answers.size());
  int pressed = -1;
  if (!dialog.fresh && !io.WantTextInput) {
    const bool tab = compat::key_pressed(ImGuiKey_Tab);
    if (compat::key_pressed(ImGuiKey_RightArrow) || (tab && !io.KeyShift)) ++dialog.marked;
    if (compat::key_pressed(ImGuiKey_LeftArrow) || (tab && io.KeyShift)) dialog.marked += count - 1;
    dialog.marked %= count;
    for (const ImGuiKey key : {ImGuiKey_Enter, ImGuiKey_KeyPadEnter, ImGuiKey_Space})
      if (compat::key_pressed(key, false)) pressed = dialog.marked;
  }
  ImGui::Dummy({0, 4 * ui.scale});
  for (int k = 0; k < count; ++k) {
    const Answer& answer = answers[static_cast<std::size_t>(k)];
    if (k > 0) ImGui::SameLine();
    if (small_button(ui, answer.name, answer.label)) pressed = k;
    if (k != dialog.marked || io.WantTextInput) continue;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float s = ui.scale;
    ImGui::GetWindowDrawList()->AddRect({low.x - 2 * s, low.y - 2 * s}, {high.x + 2 * s, high.y + 2 * s},
                                        shade(palette::blue), ImGui::GetStyle().FrameRounding + 2 * s, 0, 1.5f * s);
  }
  return pressed;
}

std::optional<std::filesystem::path> draw_dialog(Ui& ui, const Rect& area, Dialog& dialog, const Document& document) {
  using enum Dialog::Kind;
  const bool loss = dialog.kind == comments || dialog.kind == overwrite;
  if (!loss && dialog.kind != save_as && dialog.kind != replace) return {};
  begin_dialog(ui, area);
  Decision decision;
  const Dialog::Kind shown = dialog.kind;
  if (loss) decision = loss_question(ui, dialog, document);
  if (shown == save_as) decision = name_question(ui, dialog);
  if (shown == replace) decision = replace_question(ui, dialog);
  if (dialog.kind == shown) dialog.fresh = false;
  end_dialog();
  return decision;
}

std::optional<std::filesystem::path> draw_open_dialog(Ui& ui, const Rect& area, Dialog& dialog) {
  if (dialog.kind != Dialog::Kind::open) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Open");
  note(ui, "a scene, an image that Tyndall has made of one, or a picture to measure the error against", false);
  ImGui::Dummy({0, 2 * ui.scale});
  const bool enter = draw_name_field(ui, dialog, "scene.json");
  const Answer answers[] = {{"dialog.open", "Open"}, {"dialog.cancel", "Cancel"}};
  const int answer = draw_answers(ui, dialog, answers);
  dialog.fresh = false;
  end_dialog();
  const bool opens = (enter || answer == 0) && dialog.name[0] != '\0';
  if (opens || answer == 1) dialog.kind = Dialog::Kind::none;
  return opens ? Decision(typed_file(dialog)) : Decision();
}

std::optional<bool> draw_changed_file_dialog(Ui& ui, const Rect& area, Dialog& dialog, const Document& document) {
  if (dialog.kind != Dialog::Kind::changed_file) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted(("Another program has changed " + document.origin->title + ".").c_str());
  note(ui, "You have edits of it that are not saved. If you take the file, Ctrl + Z brings them back.", false);
  const Answer answers[] = {{"dialog.keep", "Keep my edits"}, {"dialog.take", "Take the file"}};
  const int answer = draw_answers(ui, dialog, answers);
  dialog.fresh = false;
  end_dialog();
  if (answer < 0) return {};
  dialog.kind = Dialog::Kind::none;
  return answer == 1;
}

std::optional<Half> draw_halves_dialog(Ui& ui, const Rect& area, Dialog& dialog, const std::string& method_a,
                                       const std::string& method_b) {
  if (dialog.kind != Dialog::Kind::halves) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Which half do you keep?");
  const Answer answers[] = {
      {"dialog.a", "A   " + method_a}, {"dialog.b", "B   " + method_b}, {"dialog.cancel", "Cancel"}};
  const int answer = draw_answers(ui, dialog, answers);
  dialog.fresh = false;
  end_dialog();
  if (answer < 0) return {};
  dialog.kind = Dialog::Kind::none;
  if (answer == 2) return {};
  return answer == 0 ? Half::kept : Half::current;
}

}  // namespace tyndall

#include "app/window/dialog.h"

#include "app/window/system/imgui_compat.h"
#include "app/window/system/pacing.h"
#include "core/system/files.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr ImGuiWindowFlags box_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;

/// A text field for the name of a file, which takes the keyboard at first. Returns whether Return was pressed in it.
bool draw_name_field(Ui& ui, Dialog& dialog) {
  ImGui::Dummy({0, 2 * ui.scale});
  ImGui::SetNextItemWidth(420 * ui.scale);
  if (dialog.fresh) ImGui::SetKeyboardFocusHere();
  const bool enter = ImGui::InputTextWithHint("##name", dialog.hint, dialog.name, sizeof dialog.name,
                                              ImGuiInputTextFlags_EnterReturnsTrue);
  log_item(ui, "dialog.name", dialog.name);
  return enter;
}

/// The file whose name was typed: "~/" stands for the home folder, as in a shell.
std::filesystem::path typed_file(const std::string& name) {
  const std::filesystem::path home = home_folder();
  return !home.empty() && name.starts_with("~/") ? home / name.substr(2) : std::filesystem::path(name);
}

/// A row of buttons. Tab and the arrow keys mark another one, Return and the space bar press the marked one, unless a
/// text field has the keyboard. Returns the number of the one that was pressed, -1: none.
int draw_answers(Ui& ui, Dialog& dialog) {
  const ImGuiIO& io = ImGui::GetIO();
  const int count = static_cast<int>(dialog.answers.size());
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
    const Answer& answer = dialog.answers[static_cast<std::size_t>(k)];
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

/// A box with round corners in the middle of the area.
void begin_dialog(Ui& ui, const Rect& area) {
  begin_box(ui, "##dialog", {(area.x0 + area.x1) / 2, (area.y0 + area.y1) / 2}, {0.5f, 0.5f}, 0);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
}

}  // namespace

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

std::optional<Request> draw_dialog(Ui& ui, const Rect& area, Dialog& dialog) {
  if (dialog.question.empty()) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted(dialog.question.c_str());
  note(ui, dialog.note, false);
  const bool types = dialog.hint != nullptr, enter = types && draw_name_field(ui, dialog);
  const int pressed = draw_answers(ui, dialog), answer = enter ? 0 : pressed;
  dialog.fresh = false;
  end_box();
  if (answer < 0 || (answer == 0 && types && dialog.name[0] == '\0')) return {};
  std::optional<Request> request = dialog.answers[static_cast<std::size_t>(answer)].request;
  if (request && types && answer == 0) request->argument = typed_file(dialog.name).string();
  dialog = {};
  return request;
}

void Closing::begin(Dialog& dialog) {
  if (step_ == Step::writes || step_ == Step::done) return;
  discards_ = false;
  const Document* unsaved = session_.unsaved();
  if (!unsaved) return finish();
  step_ = Step::none;
  dialog = {"Save the edits of " + unsaved->origin->title + "?",
            "The file of the scene does not have them.",
            {{"dialog.save", "Save", Request{"save and close"}},
             {"dialog.discard", "Discard", Request{"discard and close"}},
             cancel_answer}};
}

void Closing::draw(Ui& ui, const Rect& area, const Dialog& dialog) {
  if (step_ == Step::saves && dialog.question.empty()) {
    step_ = Step::none;  // what was cancelled or failed leaves the window open
    if (!session_.unsaved()) finish();
  }
  if (step_ == Step::writes) draw_progress(ui, area);
}

void Closing::discard() {
  discards_ = true;
  finish();
}

/// Nothing is left but to write files; rendering would take the processors from that.
void Closing::finish() {
  step_ = Step::writes;
  since_ = clock_seconds();
  errors_before_ = session_.messages.errors();
  paused_before_ = std::exchange(session_.wanted.paused, true);
  if (session_.saving.idle()) leave();
}

void Closing::leave() {
  step_ = Step::done;
  if (discards_) session_.discard_edits();
}

void Closing::draw_progress(Ui& ui, const Rect& area) {
  const bool failed = session_.messages.errors() > errors_before_;
  if (session_.saving.idle() && failed) return static_cast<void>(cancel());  // the message says what is missing
  if (session_.saving.idle()) return leave();
  const double seconds = clock_seconds() - since_;
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Writing files; the window closes when they are there.");
  note(ui, fmt::format("{} to go, {:.0f} s; rendering is stopped", session_.saving.open(), std::floor(seconds)), false);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = 360 * ui.scale, height = 4 * ui.scale, part = 0.3f * width;
  const float left = (width - part) * static_cast<float>(0.5 - 0.5 * std::cos(2 * seconds));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, shade(palette::field), height / 2);
  draw->AddRectFilled({at.x + left, at.y}, {at.x + left + part, at.y + height}, shade(palette::blue), height / 2);
  ImGui::Dummy({width, height + 8 * ui.scale});
  if (small_button(ui, "dialog.stay", "Stay open")) cancel();
  end_box();
  if (ui.log) ui.log->changed("closing", "writes");
  ui.wake_in = std::min(ui.wake_in, 0.1);
}

bool Closing::cancel() {
  if (step_ != Step::writes) return false;
  step_ = Step::none;
  session_.wanted.paused = paused_before_;
  return true;
}

}  // namespace tyndall

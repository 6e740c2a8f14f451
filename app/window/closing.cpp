#include "app/window/closing.h"

#include "app/window/system/clock.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

namespace tyndall {

void Closing::begin(Dialog& dialog) {
  if (step_ == Step::writes || step_ == Step::done) return;
  discards_ = false;
  const Document* unsaved = session_.unsaved();
  if (!unsaved) return finish();
  step_ = Step::asking;
  dialog = close_dialog(*unsaved->origin);
}

void Closing::draw(Ui& ui, const Rect& area, const Dialog& dialog) {
  if (step_ == Step::asking && dialog.kind != Dialog::Kind::close) step_ = Step::none;
  if (step_ == Step::saves && dialog.kind == Dialog::Kind::none) {
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
  step_ = session_.writes_files() ? Step::writes : Step::done;
  since_ = clock_seconds();
  errors_before_ = session_.messages().errors();
  paused_before_ = std::exchange(session_.wanted().paused, true);
  if (step_ == Step::done) leave();
}

void Closing::leave() {
  step_ = Step::done;
  if (discards_) session_.discard_edits();
}

void Closing::draw_progress(Ui& ui, const Rect& area) {
  const bool failed = session_.messages().errors() > errors_before_;
  if (!session_.writes_files() && failed) return static_cast<void>(cancel());  // the message says what is missing
  if (!session_.writes_files()) return leave();
  const double seconds = clock_seconds() - since_;
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Writing files; the window closes when they are there.");
  note(ui, fmt::format("{} to go, {:.0f} s; rendering is stopped", session_.jobs_of_writing(), std::floor(seconds)),
       false);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = 360 * ui.scale, height = 4 * ui.scale, part = 0.3f * width;
  const float left = (width - part) * static_cast<float>(0.5 - 0.5 * std::cos(2 * seconds));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, shade(palette::field), height / 2);
  draw->AddRectFilled({at.x + left, at.y}, {at.x + left + part, at.y + height}, shade(palette::blue), height / 2);
  ImGui::Dummy({width, height + 8 * ui.scale});
  if (small_button(ui, "dialog.stay", "Stay open")) cancel();
  end_dialog();
  if (ui.log) ui.log->changed("closing", "writes");
  ui.wake_in = std::min(ui.wake_in, 0.1);
}

bool Closing::cancel() {
  if (step_ != Step::writes) return false;
  step_ = Step::none;
  session_.wanted().paused = paused_before_;
  return true;
}

}  // namespace tyndall

#include "app/window/system/input_queue.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace tyndall {
namespace {

/// Whether a key press may move the keyboard from one control to another, or from shortcuts to a dialog.
bool moves_the_keyboard(const RawInput& input) {
  if (input.kind != RawInput::Kind::key || input.action != GLFW_PRESS) return false;
  const bool ends = input.code == GLFW_KEY_ENTER || input.code == GLFW_KEY_KP_ENTER || input.code == GLFW_KEY_TAB ||
                    input.code == GLFW_KEY_ESCAPE;
  const bool modifier = input.code >= GLFW_KEY_LEFT_SHIFT && input.code <= GLFW_KEY_RIGHT_SUPER;
  return ends || (!modifier && (input.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0);
}

}  // namespace

bool InputQueue::ready() const {
  if (waiting_.empty()) return false;
  const RawInput& next = waiting_.front();
  // A modifier that is released with the button is still held where the interface sees the click.
  if (next.kind == RawInput::Kind::key && next.action == GLFW_RELEASE) return !button_now_;
  if (next.kind == RawInput::Kind::key || next.kind == RawInput::Kind::character) return frames_ >= settling_frames;
  if (next.kind == RawInput::Kind::button) return !button_now_ && !key_now_;
  return !button_now_;
}

RawInput InputQueue::take() {
  const RawInput next = waiting_.front();
  waiting_.pop_front();
  button_now_ = button_now_ || next.kind == RawInput::Kind::button;
  const bool key = next.kind == RawInput::Kind::key && next.action != GLFW_RELEASE;
  key_now_ = key_now_ || key || next.kind == RawInput::Kind::character;
  if (next.kind == RawInput::Kind::button || moves_the_keyboard(next)) frames_ = 0;
  return next;
}

void InputQueue::on_frame() {
  button_now_ = key_now_ = false;
  frames_ = std::min(frames_ + 1, settling_frames);
}

}  // namespace tyndall

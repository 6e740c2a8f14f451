#include "app/window/system/input_queue.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <string>

using namespace tyndall;

namespace {

using Kind = RawInput::Kind;

/// What each frame sees, a letter an event and a bar a frame: "b|b||||||cc|".
std::string frames_of(InputQueue& queue) {
  std::string seen;
  for (int frame = 0; frame < 100 && !queue.empty(); ++frame) {
    while (queue.ready()) seen += "kcbms"[static_cast<int>(queue.take().kind)];
    queue.on_frame();
    seen += '|';
  }
  return seen;
}

}  // namespace

TEST_CASE("what is typed after a click waits until the click has moved the keyboard") {
  InputQueue queue;
  queue.push({.kind = Kind::motion});
  queue.push({.kind = Kind::button, .action = GLFW_PRESS});
  queue.push({.kind = Kind::button, .action = GLFW_RELEASE});
  for (int k = 0; k < 2; ++k) {
    queue.push({.kind = Kind::key, .code = '5', .action = GLFW_PRESS});
    queue.push({.kind = Kind::character, .character = '5'});
    queue.push({.kind = Kind::key, .code = '5', .action = GLFW_RELEASE});
  }
  CHECK(frames_of(queue) == "mb|b||||||kckkck|");
}

TEST_CASE("a click waits for the frame of what was typed before, and the pointer stays where it clicked") {
  InputQueue queue;
  queue.push({.kind = Kind::character, .character = '5'});
  queue.push({.kind = Kind::button, .action = GLFW_PRESS});
  queue.push({.kind = Kind::motion});
  queue.push({.kind = Kind::motion});
  CHECK(frames_of(queue) == "c|b|mm|");
}

TEST_CASE("a modifier that is released with the button counts for the click") {
  InputQueue queue;
  queue.push({.kind = Kind::button, .action = GLFW_PRESS});
  queue.push({.kind = Kind::button, .action = GLFW_RELEASE});
  queue.push({.kind = Kind::key, .code = GLFW_KEY_LEFT_SHIFT, .action = GLFW_RELEASE});
  CHECK(frames_of(queue) == "b|b|k|");
}

TEST_CASE("what is typed after Tab, Return, Esc or a shortcut waits, what is typed without them does not") {
  for (const int key : {GLFW_KEY_TAB, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER, GLFW_KEY_ESCAPE}) {
    InputQueue queue;
    queue.push({.kind = Kind::key, .code = key, .action = GLFW_PRESS});
    queue.push({.kind = Kind::character, .character = '1'});
    CHECK(frames_of(queue) == "k||||||c|");
  }
  InputQueue shortcut;
  shortcut.push(
      {.kind = Kind::key, .code = GLFW_KEY_LEFT_CONTROL, .action = GLFW_PRESS, .modifiers = GLFW_MOD_CONTROL});
  shortcut.push({.kind = Kind::key, .code = 'S', .action = GLFW_PRESS, .modifiers = GLFW_MOD_CONTROL});
  shortcut.push({.kind = Kind::character, .character = 'a'});
  CHECK(frames_of(shortcut) == "kk||||||c|");
  InputQueue plain;
  plain.push({.kind = Kind::key, .code = GLFW_KEY_BACKSPACE, .action = GLFW_PRESS});
  plain.push({.kind = Kind::character, .character = 'a'});
  CHECK(frames_of(plain) == "kc|");
}

#include "app/window/system/input_events.h"

#include "tests/app/window/panels/null_imgui.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tyndall::test::input_queue_test {

namespace {

using Kind = RawInput::Kind;

/// What each frame sees, a letter an event and a bar a frame: "b|b||||||cc|".
std::string frames_of(InputQueue& queue) {
  std::string seen;
  for (int frame = 0; frame < 100 && !queue.empty(); ++frame) {
    while (const auto input = queue.take()) seen += "kcbmsf"[static_cast<int>(input->kind)];
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
  CHECK(frames_of(queue) == "mb|b||||||kc|k|kc|k|");
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
  CHECK(frames_of(plain) == "k|c|");
}

namespace {

constexpr int control = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;

RawInput key(int code, int action, int modifiers = 0) {
  return {.kind = Kind::key, .code = code, .action = action, .modifiers = modifiers};
}
/// A key that is pressed and released with modifiers, and the character that it types.
void tap(std::vector<RawInput>& events, int code, int modifiers, unsigned character = 0) {
  const std::pair<int, int> held[] = {{control, GLFW_KEY_LEFT_CONTROL}, {shift, GLFW_KEY_RIGHT_SHIFT}};
  for (const auto& [flag, modifier] : held)
    if ((modifiers & flag) != 0) events.push_back(key(modifier, GLFW_PRESS));
  events.push_back(key(code, GLFW_PRESS, modifiers));
  if (character) events.push_back({.kind = Kind::character, .character = character});
  events.push_back(key(code, GLFW_RELEASE, modifiers));
  for (const auto& [flag, modifier] : held)
    if ((modifiers & flag) != 0) events.push_back(key(modifier, GLFW_RELEASE, modifiers));
}

ImGuiKey imgui_key(int code) {
  static constexpr std::pair<int, ImGuiKey> keys[] = {
      {'A', ImGuiKey_A},
      {'C', ImGuiKey_C},
      {'V', ImGuiKey_V},
      {'X', ImGuiKey_X},
      {'Z', ImGuiKey_Z},
      {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
      {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
      {GLFW_KEY_HOME, ImGuiKey_Home},
      {GLFW_KEY_END, ImGuiKey_End},
      {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
      {GLFW_KEY_DELETE, ImGuiKey_Delete},
  };
  for (const auto& [from, to] : keys)
    if (from == code) return to;
  return ImGuiKey_COUNT;
}

/// A text box that sees what a queue delivers.
class TextBox {
 public:
  TextBox() {
    for (int k = 0; k < 4; ++k) draw();
  }
  /// The text after these events, of which so many come within each frame.
  std::string after(const std::vector<RawInput>& events, std::size_t at_once) {
    for (std::size_t k = 0; k < events.size(); ++k) {
      queue_.push(events[k]);
      if ((k + 1) % at_once == 0 || k + 1 == events.size())
        while (!queue_.empty()) draw();
    }
    return text_;
  }

 private:
  void draw() {
    while (const auto input = queue_.take()) deliver(*input);
    compat::modifiers(ImGui::GetIO(), held(GLFW_KEY_LEFT_CONTROL), held(GLFW_KEY_RIGHT_SHIFT), false, false);
    imgui_.frame([&] {
      ImGui::Begin("box");
      if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
      ImGui::InputText("##text", text_, sizeof text_);
      ImGui::End();
    });
    queue_.on_frame();
  }
  bool held(int key) const { return modifiers_.contains(key); }
  void deliver(const RawInput& input) {
    if (input.kind == Kind::character) ImGui::GetIO().AddInputCharacter(input.character);
    if (input.kind != Kind::key) return;
    if (is_modifier(input.code))
      input.action == GLFW_PRESS ? void(modifiers_.insert(input.code)) : void(modifiers_.erase(input.code));
    if (const ImGuiKey name = imgui_key(input.code); name != ImGuiKey_COUNT)
      compat::key(ImGui::GetIO(), name, input.action != GLFW_RELEASE);
  }

  NullImGui imgui_;
  InputQueue queue_;
  std::set<int> modifiers_;
  char text_[256] = "";
};

std::string text_after(const std::vector<RawInput>& events, std::size_t at_once) {
  return TextBox().after(events, at_once);
}

}  // namespace

TEST_CASE("Ctrl + A within one frame selects all, though Ctrl is let go in it, too") {
  std::vector<RawInput> events;
  for (const char c : {'A', 'C', 'V'}) tap(events, c, 0, static_cast<unsigned>(c - 'A' + 'a'));
  tap(events, 'A', control);
  tap(events, 'X', 0, 'x');
  for (const std::size_t at_once : {1u, 2u, 3u, 100u}) CHECK(text_after(events, at_once) == "x");
}

TEST_CASE("each key acts with its own modifiers and in its turn, however many come within one frame") {
  std::vector<RawInput> events;
  for (const char c : {'A', 'A', 'C', 'X', 'X'}) tap(events, c, 0, static_cast<unsigned>(c));
  tap(events, GLFW_KEY_LEFT, shift);
  tap(events, GLFW_KEY_LEFT, shift);
  tap(events, 'X', control);
  tap(events, GLFW_KEY_HOME, 0);
  tap(events, 'V', control);
  tap(events, 'V', control);
  tap(events, GLFW_KEY_RIGHT, 0);
  tap(events, 'Z', 0, 'z');
  tap(events, GLFW_KEY_BACKSPACE, 0);
  tap(events, GLFW_KEY_BACKSPACE, 0);
  tap(events, 'C', shift, 'C');
  CHECK(text_after(events, 1) == "XXXXCAC");
  CHECK(text_after(events, 1000) == text_after(events, 1));
}

TEST_CASE("random keys within frames of any length leave the same text as one by one") {
  const int keys[] = {'A',
                      'C',
                      'V',
                      'X',
                      'Z',
                      GLFW_KEY_LEFT,
                      GLFW_KEY_RIGHT,
                      GLFW_KEY_END,
                      GLFW_KEY_HOME,
                      GLFW_KEY_DELETE,
                      GLFW_KEY_BACKSPACE};
  std::mt19937 random(1);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  for (int trial = 0; trial < 15; ++trial) {
    std::vector<RawInput> events;
    for (int k = 0; k < 30; ++k) {
      const int code = keys[below(std::size(keys))], modifiers[] = {0, 0, 0, shift, control, control | shift};
      const int held = modifiers[below(std::size(modifiers))];
      const bool types = code < 128 && (held & control) == 0;
      tap(events, code, held, types ? static_cast<unsigned>(held ? code : code - 'A' + 'a') : 0u);
    }
    const std::string slowly = text_after(events, 1);
    CHECK(text_after(events, 1 + below(20)) == slowly);
    CHECK(text_after(events, 1000) == slowly);
  }
}

TEST_CASE("a button and the wheel are seen with the modifiers that were held, not with those that came after") {
  InputQueue queue;
  queue.push(key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS));
  queue.push({.kind = Kind::scroll, .y = 1});
  queue.push(key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE));
  queue.push({.kind = Kind::scroll, .y = 1});
  queue.push(key(GLFW_KEY_LEFT_ALT, GLFW_PRESS));
  queue.push({.kind = Kind::button, .action = GLFW_PRESS});
  queue.push({.kind = Kind::button, .action = GLFW_RELEASE});
  queue.push(key(GLFW_KEY_LEFT_ALT, GLFW_RELEASE));
  CHECK(frames_of(queue) == "ks|ks|kb|b|k|");
}

TEST_CASE("a key that is let go at once is held for a frame, and one that repeats while it is held waits for none") {
  InputQueue queue;
  queue.push(key('W', GLFW_PRESS));
  queue.push(key('W', GLFW_RELEASE));
  CHECK(frames_of(queue) == "k|k|");
  for (const int action : {GLFW_PRESS, GLFW_REPEAT, GLFW_REPEAT}) queue.push(key(GLFW_KEY_BACKSPACE, action));
  CHECK(frames_of(queue) == "kkk|");
}

TEST_CASE("what is typed after F2 or Insert waits for the keyboard, what follows an arrow does not") {
  for (const int code : {GLFW_KEY_F2, GLFW_KEY_INSERT}) {
    InputQueue queue;
    queue.push(key(code, GLFW_PRESS));
    queue.push({.kind = Kind::character, .character = 'a'});
    CHECK(frames_of(queue) == "k||||||c|");
  }
  InputQueue queue;
  queue.push(key(GLFW_KEY_LEFT, GLFW_PRESS));
  queue.push({.kind = Kind::character, .character = 'a'});
  CHECK(frames_of(queue) == "k|c|");
}

TEST_CASE("the focus is lost once a frame has seen what came before") {
  InputQueue queue;
  queue.push(key('S', GLFW_PRESS, control));
  queue.push({.kind = Kind::focus, .action = 0});
  queue.push(key('S', GLFW_RELEASE));
  CHECK(frames_of(queue) == "k|fk|");
}

}  // namespace tyndall::test::input_queue_test

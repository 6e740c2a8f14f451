#include "app/window/system/input_events.h"
#include "tests/app/window/null_imgui.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <random>
#include <set>

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

constexpr int control = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;
const RawInput press{.kind = Kind::button, .action = GLFW_PRESS}, release{.kind = Kind::button, .action = GLFW_RELEASE},
    motion{.kind = Kind::motion}, scroll{.kind = Kind::scroll, .y = 1};

RawInput key(int code, int action, int modifiers = 0) {
  return {.kind = Kind::key, .code = code, .action = action, .modifiers = modifiers};
}
RawInput down(int code, int modifiers = 0) { return key(code, GLFW_PRESS, modifiers); }
RawInput up(int code) { return key(code, GLFW_RELEASE); }
RawInput typed(char c) { return {.kind = Kind::character, .character = static_cast<unsigned>(c)}; }

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

constexpr std::pair<int, ImGuiKey> keys[] = {{'A', ImGuiKey_A},
                                             {'C', ImGuiKey_C},
                                             {'V', ImGuiKey_V},
                                             {'X', ImGuiKey_X},
                                             {'Z', ImGuiKey_Z},
                                             {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
                                             {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
                                             {GLFW_KEY_HOME, ImGuiKey_Home},
                                             {GLFW_KEY_END, ImGuiKey_End},
                                             {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
                                             {GLFW_KEY_DELETE, ImGuiKey_Delete}};

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
    for (const auto& [code, name] : keys)
      if (code == input.code) compat::key(ImGui::GetIO(), name, input.action != GLFW_RELEASE);
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

TEST_CASE("each key acts with its own modifiers and in its turn, however many come within one frame") {
  std::vector<RawInput> events;
  for (const char c : {'C', 'V'}) tap(events, c, 0, static_cast<unsigned>(c));
  tap(events, 'A', control);  // selects all, though Ctrl is let go at once
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
  for (const std::size_t at_once : {1u, 2u, 3u, 1000u}) CHECK(text_after(events, at_once) == "XXXXCAC");
}

TEST_CASE("random keys within frames of any length leave the same text as one by one") {
  std::mt19937 random(1);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  for (int trial = 0; trial < 15; ++trial) {
    std::vector<RawInput> events;
    for (int k = 0; k < 30; ++k) {
      const int code = keys[below(std::size(keys))].first, modifiers[] = {0, 0, 0, shift, control, control | shift};
      const int held = modifiers[below(std::size(modifiers))];
      const bool types = code < 128 && (held & control) == 0;
      tap(events, code, held, types ? static_cast<unsigned>(held ? code : code - 'A' + 'a') : 0u);
    }
    const std::string slowly = text_after(events, 1);
    CHECK(text_after(events, 1 + below(20)) == slowly);
    CHECK(text_after(events, 1000) == slowly);
  }
}

TEST_CASE("each event comes in a frame in which it is not misread") {
  struct Case {
    const char* what;
    std::vector<RawInput> events;
    const char* frames;
  };
  std::vector<Case> cases{
      {"what is typed after a click waits until the click has moved the keyboard",
       {motion, press, release, down('5'), typed('5'), up('5'), down('5'), typed('5'), up('5')},
       "mb|b||||||kc|k|kc|k|"},
      {"a click waits for the frame of what was typed before, and the pointer stays where it clicked",
       {typed('5'), press, motion, motion},
       "c|b|mm|"},
      {"a modifier that is released with the button counts for the click",
       {press, release, up(GLFW_KEY_LEFT_SHIFT)},
       "b|b|k|"},
      {"a button and the wheel are seen with the modifiers that were held, not with those that came after",
       {down(GLFW_KEY_LEFT_CONTROL), scroll, up(GLFW_KEY_LEFT_CONTROL), scroll, down(GLFW_KEY_LEFT_ALT), press, release,
        up(GLFW_KEY_LEFT_ALT)},
       "ks|ks|kb|b|k|"},
      {"what is typed after a shortcut waits",
       {down(GLFW_KEY_LEFT_CONTROL, control), down('S', control), typed('a')},
       "kk||||||c|"},
      {"a key that is let go at once is held for a frame", {down('W'), up('W')}, "k|k|"},
      {"a key that repeats while it is held waits for none",
       {down(GLFW_KEY_BACKSPACE), key(GLFW_KEY_BACKSPACE, GLFW_REPEAT), key(GLFW_KEY_BACKSPACE, GLFW_REPEAT)},
       "kkk|"},
      {"the focus is lost once a frame has seen what came before",
       {down('S', control), {.kind = Kind::focus, .action = 0}, up('S')},
       "k|fk|"}};
  for (const int code :
       {GLFW_KEY_TAB, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER, GLFW_KEY_ESCAPE, GLFW_KEY_F2, GLFW_KEY_INSERT})
    cases.push_back({"a key that moves the keyboard", {down(code), typed('1')}, "k||||||c|"});
  for (const int code : {GLFW_KEY_BACKSPACE, GLFW_KEY_LEFT})
    cases.push_back({"a key that stays in the text", {down(code), typed('a')}, "k|c|"});
  for (const auto& [what, events, frames] : cases) {
    InputQueue queue;
    for (const RawInput& event : events) queue.push(event);
    CHECK_MESSAGE(frames_of(queue) == frames, what);
  }
}

}  // namespace tyndall::test::input_queue_test

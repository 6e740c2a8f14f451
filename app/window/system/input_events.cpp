#include "app/window/system/input_events.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tyndall {

namespace {

/// What an event is for the events around it; a bit of InputQueue::seen_.
enum Role : unsigned {
  nothing = 0,  ///< a key that repeats while it is held
  release = 1,
  shift = 2,      ///< pressed or released; it changes no character that comes
  modifier = 4,   ///< Ctrl, Alt or Super
  plain_key = 8,  ///< its character follows, if there is one
  acting_key = 16,
  character = 32,
  button = 64,
  motion = 128,
  scroll = 256,
  focus = 512
};

bool is_between(int key, int first, int last) { return key >= first && key <= last; }

/// Whether a key that is pressed without Ctrl, Alt and Super only types a character.
bool types(int key) {
  return is_between(key, GLFW_KEY_SPACE, GLFW_KEY_WORLD_2) || is_between(key, GLFW_KEY_KP_0, GLFW_KEY_KP_ADD) ||
         key == GLFW_KEY_KP_EQUAL;
}

Role role_of_key(const RawInput& input) {
  if (input.action == GLFW_REPEAT) return nothing;
  if (input.code == GLFW_KEY_LEFT_SHIFT || input.code == GLFW_KEY_RIGHT_SHIFT) return shift;
  if (is_modifier(input.code)) return modifier;
  if (input.action == GLFW_RELEASE) return release;
  const bool chord = (input.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0;
  return types(input.code) && !chord ? plain_key : acting_key;
}

Role role_of(const RawInput& input) {
  constexpr Role roles[] = {nothing, character, button, motion, scroll, focus};  // in the order of RawInput::Kind
  return input.kind == RawInput::Kind::key ? role_of_key(input) : roles[static_cast<int>(input.kind)];
}

/// What must not have been delivered for the same frame before.
unsigned waits_for(Role role) {
  constexpr std::pair<Role, unsigned> rules[] = {
      {shift, acting_key | button | motion | scroll},
      {modifier, plain_key | acting_key | character | button | motion | scroll},
      {plain_key, acting_key},
      {character, acting_key | button},
      {acting_key, acting_key | character},
      {button, plain_key | acting_key | character | button},
      {motion, button},
      {scroll, button},
      {focus, ~unsigned(release)}};
  const auto* rule =
      std::find_if(std::begin(rules), std::end(rules), [role](const auto& one) { return one.first == role; });
  return rule == std::end(rules) ? 0 : rule->second;
}

/// Whether an acting key stays within the text or list that has the keyboard.
bool stays(int key) {
  return is_between(key, GLFW_KEY_BACKSPACE, GLFW_KEY_END) && key != GLFW_KEY_INSERT;  // and Delete, arrows, pages
}

}  // namespace

bool is_modifier(int key) { return is_between(key, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SUPER); }

bool InputQueue::waits(const RawInput& input) const {
  const Role role = role_of(input);
  if ((seen_ & waits_for(role)) != 0) return true;
  if (role != plain_key && role != acting_key && role != character) return false;
  const bool again = role != character && (down_.contains(input.code) || was_down_.contains(input.code));
  return again || frames_ < settling_frames;
}

std::optional<RawInput> InputQueue::take() {
  while (!waiting_.empty() && !waits(waiting_.front())) {
    const RawInput next = waiting_.front();
    waiting_.pop_front();
    const Role role = role_of(next);
    if (role == release && down_.contains(next.code) && !was_down_.contains(next.code)) {
      late_.push_back(next);
      continue;
    }
    seen_ |= role;
    if (role == release) down_.erase(next.code);
    if (role == plain_key || role == acting_key) down_.insert(next.code);
    if (role == button || (role == acting_key && !stays(next.code))) frames_ = 0;
    return next;
  }
  return {};
}

void InputQueue::on_frame() {
  waiting_.insert(waiting_.begin(), late_.begin(), late_.end());
  late_.clear();
  was_down_ = down_;
  seen_ = 0;
  frames_ = std::min(frames_ + 1, settling_frames);
}

Mouse read_mouse() {
  const ImGuiIO& io = ImGui::GetIO();
  Mouse mouse;
  mouse.x = io.MousePos.x, mouse.y = io.MousePos.y;
  mouse.dx = io.MouseDelta.x, mouse.dy = io.MouseDelta.y;
  mouse.wheel = io.MouseWheel;
  for (int button = 0; button < 3; ++button) {
    mouse.clicked[button] = ImGui::IsMouseClicked(button);
    mouse.down[button] = io.MouseDown[button];
    mouse.pressed_x[button] = io.MouseClickedPos[button].x;
    mouse.pressed_y[button] = io.MouseClickedPos[button].y;
  }
  mouse.control = io.KeyCtrl, mouse.shift = io.KeyShift, mouse.alt = io.KeyAlt;
  mouse.taken = io.WantCaptureMouse;
  mouse.typing = io.WantTextInput;
  return mouse;
}

}  // namespace tyndall

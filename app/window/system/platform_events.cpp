#include "app/window/system/platform_events.h"

#include "app/window/system/imgui_compat.h"
#include "app/window/system/pacing.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace tyndall {
namespace {

WindowState& state_of(GLFWwindow* window) { return *static_cast<WindowState*>(glfwGetWindowUserPointer(window)); }

/// The letter that a key has on the user's keyboard, as GLFW's number; '+' and '-' for the keys that type them, also
/// where '+' needs Shift. Other keys stay.
int named_key(int key, int scancode) {
  if (key == GLFW_KEY_KP_ADD) return '+';
  if (key == GLFW_KEY_KP_SUBTRACT) return '-';
  if (key <= GLFW_KEY_SPACE || key > 'a') return key;  // also what GLFW does not know
  const char* name = glfwGetKeyName(key, scancode);
  if (name && name[1] == '\0' && (name[0] == '+' || name[0] == '=')) return '+';
  if (name && name[1] == '\0' && name[0] == '-') return '-';
  if (key < 'A' || key > 'Z') return key;
  const bool letter = name && name[1] == '\0' && name[0] >= 'a' && name[0] <= 'z';
  return letter ? name[0] - 'a' + 'A' : key;
}

/// The flags of the modifier keys that are held.
int flags_of(const std::set<int>& keys) {
  int flags = 0;
  for (const int key : keys) {
    const int side = (key - GLFW_KEY_LEFT_SHIFT) % 4;  // Shift, Ctrl, Alt, Super, and again on the right
    flags |= GLFW_MOD_SHIFT << side;
  }
  return flags;
}

void deliver_key(WindowState& state, const RawInput& input) {
  ImGui_ImplGlfw_KeyCallback(state.window, input.code, input.scancode, input.action, input.modifiers);
  const bool typing = ImGui::GetIO().WantTextInput;
  const int name = named_key(input.code, input.scancode), mods = input.modifiers;
  if (input.action == GLFW_RELEASE) {
    state.held.erase(name);
    state.modifier_keys.erase(input.code);
  }
  if (input.action == GLFW_PRESS && is_modifier(input.code)) state.modifier_keys.insert(input.code);
  if (is_modifier(input.code)) state.modifiers = flags_of(state.modifier_keys);
  if (input.action != GLFW_PRESS) return;
  if (!is_modifier(input.code)) state.modifiers = mods;
  const bool chord = (mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0;
  if (!typing && !chord) state.held.insert(name);
  const bool shift = (mods & GLFW_MOD_SHIFT) != 0 && name != '+';
  const Modifiers modifiers{(mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0, shift, (mods & GLFW_MOD_ALT) != 0};
  state.events.keys.push_back({name, modifiers, typing});
}

void deliver_pointer(WindowState& state, const RawInput& input) {
  state.somewhere = true;
  state.x = static_cast<float>(input.x);
  state.y = static_cast<float>(input.y);
#if IMGUI_VERSION_NUM >= 18700
  ImGui_ImplGlfw_CursorPosCallback(state.window, input.x, input.y);
#endif
}

void deliver_button(WindowState& state, const RawInput& input) {
  deliver_pointer(state, input);
  ImGui_ImplGlfw_MouseButtonCallback(state.window, input.code, input.action, input.modifiers);
  state.modifiers = input.modifiers;
  if (input.code < 0 || input.code > 2) return;
  state.down[input.code] = input.action == GLFW_PRESS;
  state.clicked[input.code] = state.clicked[input.code] || input.action == GLFW_PRESS;
}

void deliver(WindowState& state, const RawInput& input) {
  switch (input.kind) {
    case RawInput::Kind::key:
      return deliver_key(state, input);
    case RawInput::Kind::character:
      if (input.character < 128) {
        const bool typing = ImGui::GetIO().WantTextInput;
        state.events.keys.push_back({0, {}, typing, static_cast<char>(input.character)});
      }
      return ImGui_ImplGlfw_CharCallback(state.window, input.character);
    case RawInput::Kind::button:
      return deliver_button(state, input);
    case RawInput::Kind::motion:
      return deliver_pointer(state, input);
    case RawInput::Kind::scroll:
      return ImGui_ImplGlfw_ScrollCallback(state.window, input.x, input.y);
    case RawInput::Kind::focus:
      // Dear ImGui takes all keys as released where the focus is lost.
      if (input.action == 0) state.held.clear(), state.modifier_keys.clear(), state.modifiers = 0;
      return ImGui_ImplGlfw_WindowFocusCallback(state.window, input.action);
  }
}

void push(GLFWwindow* window, RawInput input) {
  input.time = clock_seconds();
  state_of(window).queue.push(input);
}

void push_motion(GLFWwindow* window, double x, double y) {
  WindowState& state = state_of(window);
  state.told_x = x, state.told_y = y;
  push(window, {.kind = RawInput::Kind::motion, .x = x, .y = y});
}

}  // namespace

void install_callbacks(GLFWwindow* window) {
  using Kind = RawInput::Kind;
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    push(w, {.kind = Kind::key, .code = key, .scancode = scancode, .action = action, .modifiers = mods});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned c) { push(w, {.kind = Kind::character, .character = c}); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    const WindowState& state = state_of(w);
    push(w, {.kind = Kind::button,
             .code = button,
             .action = action,
             .modifiers = mods,
             .x = state.told_x,
             .y = state.told_y});
  });
  glfwSetScrollCallback(window,
                        [](GLFWwindow* w, double x, double y) { push(w, {.kind = Kind::scroll, .x = x, .y = y}); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { push_motion(w, x, y); });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    state_of(w).events.any = true;
    double x = 0, y = 0;
    glfwGetCursorPos(w, &x, &y);
    if (entered) push_motion(w, x, y);
    ImGui_ImplGlfw_CursorEnterCallback(w, entered);
  });
  glfwSetWindowFocusCallback(window,
                             [](GLFWwindow* w, int focused) { push(w, {.kind = Kind::focus, .action = focused}); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { state_of(w).events.any = true; });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { state_of(w).events.any = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { state_of(w).events.any = true; });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { state_of(w).events.any = true; });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
    state_of(w).events.any = true;
    for (int k = 0; k < count; ++k) state_of(w).events.dropped.emplace_back(files[k]);
  });
}

void deliver_input(WindowState& state) {
  while (const auto input = state.queue.take()) {
    if (state.events.first <= 0) state.events.first = input->time;
    state.events.any = true;
    deliver(state, *input);
  }
  if (!state.queue.empty()) state.events.any = true;  // draws the frame that the rest waits for
}

void set_delivered_input(const WindowState& state) {
  ImGuiIO& io = ImGui::GetIO();
  const auto held = [&](int flag) { return (state.modifiers & flag) != 0; };
  compat::modifiers(io, held(GLFW_MOD_CONTROL), held(GLFW_MOD_SHIFT), held(GLFW_MOD_ALT), held(GLFW_MOD_SUPER));
#if IMGUI_VERSION_NUM < 18700
  const bool outside = io.MousePos.x < -1e6f;
  if (state.somewhere && !outside) io.MousePos = {state.x, state.y};
  for (int button = 0; button < 3; ++button) io.MouseDown[button] = state.down[button] || state.clicked[button];
#endif
}

void end_input_frame(WindowState& state) {
  state.queue.on_frame();
  if (!state.queue.empty()) state.events.any = true;
  for (bool& clicked : state.clicked) clicked = false;
  state.modifiers = flags_of(state.modifier_keys);
}

}  // namespace tyndall

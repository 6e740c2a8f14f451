#include "app/window/system/platform_events.h"

#include "app/window/system/clock.h"

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

void deliver_key(GLFWwindow* window, const RawInput& input) {
  WindowState& state = state_of(window);
  const int name = named_key(input.code, input.scancode);
  if (input.action == GLFW_RELEASE && state.pressed.contains(input.code)) {
    // Before 1.87 Dear ImGui sees keys only once a frame and would miss this press.
    state.late.emplace_back(input.code, input.scancode);
  } else {
    ImGui_ImplGlfw_KeyCallback(window, input.code, input.scancode, input.action, input.modifiers);
  }
  const bool typing = ImGui::GetIO().WantTextInput;
  if (input.action == GLFW_RELEASE) {
    state.held.erase(name);
    return;
  }
  if (input.action != GLFW_PRESS) return;
  state.pressed.insert(input.code);
  const int mods = input.modifiers;
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
  if (input.code < 0 || input.code > 2) return;
  state.down[input.code] = input.action == GLFW_PRESS;
  state.clicked[input.code] = state.clicked[input.code] || input.action == GLFW_PRESS;
}

void deliver(GLFWwindow* window, const RawInput& input) {
  switch (input.kind) {
    case RawInput::Kind::key:
      return deliver_key(window, input);
    case RawInput::Kind::character:
      if (input.character < 128) {
        const bool typing = ImGui::GetIO().WantTextInput;
        state_of(window).events.keys.push_back({0, {}, typing, static_cast<char>(input.character)});
      }
      return ImGui_ImplGlfw_CharCallback(window, input.character);
    case RawInput::Kind::button:
      return deliver_button(state_of(window), input);
    case RawInput::Kind::motion:
      return deliver_pointer(state_of(window), input);
    case RawInput::Kind::scroll:
      return ImGui_ImplGlfw_ScrollCallback(window, input.x, input.y);
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
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    state_of(w).events.any = true;
    if (!focused) state_of(w).held.clear();
    ImGui_ImplGlfw_WindowFocusCallback(w, focused);
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { state_of(w).events.any = true; });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { state_of(w).events.any = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { state_of(w).events.any = true; });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { state_of(w).events.any = true; });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
    state_of(w).events.any = true;
    for (int k = 0; k < count; ++k) state_of(w).events.dropped.emplace_back(files[k]);
  });
}

void deliver_input(GLFWwindow* window) {
  WindowState& state = state_of(window);
  while (state.queue.ready()) {
    const RawInput input = state.queue.take();
    if (state.events.first <= 0) state.events.first = input.time;
    state.events.any = true;
    deliver(window, input);
  }
  if (!state.queue.empty()) state.events.any = true;  // draws the frame that the rest waits for
}

void set_delivered_mouse([[maybe_unused]] const WindowState& state) {
#if IMGUI_VERSION_NUM < 18700
  ImGuiIO& io = ImGui::GetIO();
  const bool outside = io.MousePos.x < -1e6f;
  if (state.somewhere && !outside) io.MousePos = {state.x, state.y};
  for (int button = 0; button < 3; ++button) io.MouseDown[button] = state.down[button] || state.clicked[button];
#endif
}

void end_input_frame(GLFWwindow* window) {
  WindowState& state = state_of(window);
  state.queue.on_frame();
  for (bool& clicked : state.clicked) clicked = false;
  state.pressed.clear();
  for (const auto& [key, scancode] : std::exchange(state.late, {})) {
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, GLFW_RELEASE, 0);
    state.events.any = true;
  }
}

}  // namespace tyndall

#include "app/window/system/platform_events.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace tyndall {
namespace {

WindowState& state_of(GLFWwindow* window) { return *static_cast<WindowState*>(glfwGetWindowUserPointer(window)); }

/// The letter that a key has on the user's keyboard, as GLFW's number; other keys stay.
int named_key(int key, int scancode) {
  if (key < 'A' || key > 'Z') return key;  // also what GLFW does not know
  const char* name = glfwGetKeyName(key, scancode);
  const bool letter = name && name[1] == '\0' && name[0] >= 'a' && name[0] <= 'z';
  return letter ? name[0] - 'a' + 'A' : key;
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
  WindowState& state = state_of(window);
  const int name = named_key(key, scancode);
  state.events.any = true;
  if (action == GLFW_RELEASE && state.pressed.contains(key)) {
    // Before 1.87 Dear ImGui sees keys only once a frame and would miss this press.
    state.late.emplace_back(key, scancode);
  } else {
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, mods);
  }
  const bool typing = ImGui::GetIO().WantTextInput;
  if (action == GLFW_RELEASE) {
    state.held.erase(name);
    return;
  }
  if (action == GLFW_PRESS) {
    state.pressed.insert(key);
    const bool chord = (mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0;
    if (!typing && !chord) state.held.insert(name);
  }
  const Modifiers modifiers{(mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0, (mods & GLFW_MOD_SHIFT) != 0,
                            (mods & GLFW_MOD_ALT) != 0};
  if (action == GLFW_PRESS) state.events.keys.push_back({name, modifiers, typing});
}

}  // namespace

void install_callbacks(GLFWwindow* window) {
  glfwSetKeyCallback(
      window, [](GLFWwindow* w, int key, int code, int action, int mods) { on_key(w, key, code, action, mods); });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned c) {
    state_of(w).events.any = true;
    ImGui_ImplGlfw_CharCallback(w, c);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    state_of(w).events.any = true;
    ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    state_of(w).events.any = true;
    ImGui_ImplGlfw_ScrollCallback(w, x, y);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, [[maybe_unused]] double x, [[maybe_unused]] double y) {
    state_of(w).events.any = true;
#if IMGUI_VERSION_NUM >= 18700
    ImGui_ImplGlfw_CursorPosCallback(w, x, y);
#endif
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    state_of(w).events.any = true;
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

void send_late_releases(GLFWwindow* window) {
  WindowState& state = state_of(window);
  state.pressed.clear();
  for (const auto& [key, scancode] : std::exchange(state.late, {})) {
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, GLFW_RELEASE, 0);
    state.events.any = true;
  }
}

}  // namespace tyndall

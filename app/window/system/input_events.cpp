#include "app/window/system/input_events.h"

#include <imgui.h>

namespace tyndall {

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

#pragma once
#include "app/window/system/input_events.h"

#include <GLFW/glfw3.h>

#include <set>
#include <string>

/// The callbacks of the window library, which collect what the user did, and its delivery frame by frame.
namespace tyndall {

/// What a window and its callbacks share; the window's user pointer.
struct WindowState {
  GLFWwindow* window = nullptr;
  std::string title;
  InputQueue queue;
  InputEvents events;
  std::set<int> held;
  int windowed[4] = {};           ///< place before full screen: x, y, width, height
  double told_x = 0, told_y = 0;  ///< where the newest callback has put the pointer

  // Modifiers and mouse as they were delivered.
  std::set<int> modifier_keys;  ///< that are held
  int modifiers = 0;            ///< GLFW's flags; of a key or button that was pressed since the last frame
  bool somewhere = false;       ///< x and y are known
  float x = 0, y = 0;
  bool down[3] = {};
  bool clicked[3] = {};  ///< pressed since the last frame
};

/// Sets all callbacks of a window: they fill its queue.
void install_callbacks(GLFWwindow* window);

/// Hands events of the queue to Dear ImGui and to the window's state, as many as belong before the next frame.
void deliver_input(WindowState& state);

/// Before Dear ImGui's frame, after its backend: sets modifiers and mouse to what was delivered, as the backend asks
/// the window system for its present state.
void set_delivered_input(const WindowState& state);

/// After a frame: what has waited for it comes next.
void end_input_frame(WindowState& state);

}  // namespace tyndall

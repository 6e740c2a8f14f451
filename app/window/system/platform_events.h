#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/input_queue.h"
#include "app/window/system/layout.h"

#include <GLFW/glfw3.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

/// The callbacks of the window library, which collect what the user did, and its delivery frame by frame.
namespace tyndall {

/// What a window and its callbacks share; the window's user pointer.
struct WindowState {
  GLFWwindow* window = nullptr;
  std::string title;
  InputQueue queue;
  InputEvents events;
  std::set<int> held;
  std::set<int> pressed;                  ///< since the last frame
  std::vector<std::pair<int, int>> late;  ///< key and scancode of releases that wait for the next frame
  Rect windowed;                          ///< place before full screen
  double told_x = 0, told_y = 0;          ///< where the newest callback has put the pointer

  // The mouse as it was delivered.
  bool somewhere = false;  ///< x and y are known
  float x = 0, y = 0;
  bool down[3] = {};
  bool clicked[3] = {};  ///< pressed since the last frame
};

/// Sets all callbacks of a window: they fill its queue.
void install_callbacks(GLFWwindow* window);

/// Hands events of the queue to Dear ImGui and to the window's state, as many as belong before the next frame.
void deliver_input(GLFWwindow* window);

/// Within Dear ImGui's frame, after its backend: sets the mouse to what was delivered, as the backend asks the window
/// system for its present state.
void set_delivered_mouse(const WindowState& state);

/// After a frame: tells Dear ImGui the releases that waited for a frame to see the press.
void end_input_frame(GLFWwindow* window);

}  // namespace tyndall

#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"

#include <GLFW/glfw3.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

/// The callbacks of the window library, which collect what the user did until the next drawing.
namespace tyndall {

/// What a window and its callbacks share; the window's user pointer.
struct WindowState {
  GLFWwindow* window = nullptr;
  std::string title;
  InputEvents events;
  std::set<int> held;
  std::set<int> pressed;                  ///< since the last frame
  std::vector<std::pair<int, int>> late;  ///< key and scancode of releases that wait for the next frame
  Rect windowed;                          ///< place before full screen
};

/// Sets all callbacks of a window: they fill its state and tell Dear ImGui.
void install_callbacks(GLFWwindow* window);

/// Tells Dear ImGui the releases that waited for a frame to see the press.
void send_late_releases(GLFWwindow* window);

}  // namespace tyndall

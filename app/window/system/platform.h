#pragma once
#include "app/window/system/input_events.h"

#include <memory>
#include <set>
#include <string>

namespace tyndall {

struct WindowState;

/// The window of the system, its OpenGL context and its events. GLFW and Dear ImGui's backends are used here only.
class Platform {
 public:
  /// A window whose image area has the given size at scale 1, smaller if the screen is. Throws IoError.
  Platform(int image_width, int image_height);
  ~Platform();
  Platform(const Platform&) = delete;
  Platform& operator=(const Platform&) = delete;

  /// Waits for events up to `seconds`; infinite: until one comes. 0: only looks.
  void wait(double seconds);
  InputEvents take_events();
  bool closing() const;
  void close();
  /// Takes the window off the screen: what is left to be done needs none.
  void hide();

  /// Sizes now: window units and pixels of the framebuffer; 0 while minimised.
  int width() const, height() const, framebuffer_width() const, framebuffer_height() const;
  /// Window units, and font pixels, per unit of the design.
  float scale() const, pixels() const;
  /// Keys that are held down, were pressed without Ctrl or Alt, and no control wants.
  const std::set<int>& held() const;
  bool shift_held() const;

  void set_title(const std::string& title);
  void toggle_full_screen();

  /// Dear ImGui's frame: begins one; draws it over what is in the framebuffer and shows it.
  void begin_frame();
  void clear();
  void end_frame();
  /// After the fonts were loaded again.
  void renew_fonts();

  /// Wakes wait(). May be called from any thread while a Platform lives.
  static void wake();

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace tyndall

#pragma once
#include "app/window/system/input_events.h"

#include <memory>
#include <set>
#include <string>

/// This room holds all that talks to the window system, to OpenGL and to Dear ImGui's backends, and what they need to
/// know: the layout, the style, when to draw, what the log says.
namespace tyndall {

struct WindowState;

/// How large a window is.
struct WindowSize {
  int width = 0, height = 0;                          ///< window units
  int framebuffer_width = 0, framebuffer_height = 0;  ///< pixels; 0 while the window is minimised
  float scale = 1;                                    ///< window units per unit of the design
  float pixels = 1;                                   ///< font pixels per unit of the design
};

/// The window of the system, its OpenGL context and its events. GLFW and Dear ImGui's backends are used here only.
class Platform {
 public:
  /// A window whose image area has the given size at scale 1, smaller if the screen is. Throws IoError.
  Platform(int image_width, int image_height);
  ~Platform();

  /// Waits for events up to `seconds`; infinite: until one comes. 0: only looks.
  void wait(double seconds);
  InputEvents take_events();
  /// Whether the user has asked the window system to close the window; the window stays, and shows if it was minimised.
  bool take_close_wish();
  /// Takes the window off the screen: what is left to be done needs none.
  void hide();

  WindowSize size() const;
  /// Keys that are held down, were pressed without Ctrl or Alt, and no control wants.
  const std::set<int>& held() const;
  bool shift_held() const;

  void set_title(const std::string& title);
  void toggle_full_screen();

  /// Dear ImGui's frame: begins one; draws it over what is in the framebuffer and shows it.
  void begin_frame();
  void clear();
  void end_frame();
  /// Ends the frame without showing it: what it did to controls and scene counts, the screen stays as it is.
  void drop_frame();
  /// No frame is drawn because nobody would see it: what waits for one goes on.
  void skip_frame();
  /// To be called after the fonts were loaded again: they are drawn from then on.
  void renew_fonts();

  /// Wakes wait(). May be called from any thread while a Platform lives.
  static void wake();

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace tyndall

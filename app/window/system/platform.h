#pragma once
#include "app/window/system/input_events.h"

#include <functional>
#include <memory>
#include <set>
#include <string>

/// This room holds all that talks to the window system, to OpenGL and to Dear ImGui's backends, and what they need to
/// know: the layout, the style, when to draw, what the log says.
namespace tyndall {

/// How large a window is.
struct WindowSize {
  int width = 0, height = 0;                          ///< window units
  int framebuffer_width = 0, framebuffer_height = 0;  ///< pixels; 0 while the window is minimised
  float scale = 1;                                    ///< window units per unit of the design
  float pixels = 1;                                   ///< font pixels per unit of the design
};

/// The window of the system, its OpenGL context and its events. Tests have one that shows nothing.
class Platform {
 public:
  virtual ~Platform() = default;

  /// Waits for events up to `seconds`; infinite: until one comes. 0: only looks.
  virtual void wait(double seconds) = 0;
  virtual InputEvents take_events() = 0;
  /// Takes the window off the screen: what is left to be done needs none.
  virtual void hide() = 0;

  virtual WindowSize size() const = 0;
  /// Keys that are held down, were pressed without Ctrl or Alt, and no control wants.
  virtual const std::set<int>& held() const = 0;

  virtual void set_title(const std::string& title) = 0;
  virtual void toggle_full_screen() = 0;

  /// Dear ImGui's frame: begins one; draws it over what is in the framebuffer and shows it.
  virtual void begin_frame() = 0;
  virtual void clear() = 0;
  virtual void end_frame() = 0;
  /// Ends the frame without showing it: what it did to controls and scene counts, the screen stays as it is.
  virtual void drop_frame() = 0;
  /// No frame is drawn because nobody would see it: what waits for one goes on.
  virtual void skip_frame() = 0;
  /// To be called after the fonts were loaded again: they are drawn from then on.
  virtual void renew_fonts() = 0;

  /// Wakes wait(). May be called from any thread while a Platform lives.
  virtual void wake() = 0;
};

/// A window whose image area has the given size at scale 1, smaller if the screen is. Throws IoError.
std::unique_ptr<Platform> open_platform(int image_width, int image_height);

/// From now on the program says so in one line and ends with exit code 3 when the X server goes away, instead of the X
/// library's words and exit code 1. Nothing happens where no X library is loaded. Call after the window was opened.
/// before_end: called first, from whichever thread has noticed it; must not use the display; may be empty. What it
/// returns is said in a line of its own, unless it is "".
void end_when_display_is_lost(std::function<std::string()> before_end);

}  // namespace tyndall

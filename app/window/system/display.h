#pragma once
#include "app/window/system/layout.h"
#include "core/scene/scene.h"

#include <vector>

/// How a rendered picture gets on the screen.
namespace tyndall {

/// How the picture is shown.
struct Look {
  double exposure = 0;  ///< stops
  ToneMap tone_map = ToneMap::srgb;
  bool dither = false;
  bool operator==(const Look&) const = default;
};

/// Puts frames on the screen with OpenGL 3.3: a float texture, tone-mapped once into a texture of bytes, which is all
/// that is copied while nothing new comes. Lives within the window's context.
class FrameDisplay {
 public:
  /// Throws IoError if the shaders do not compile.
  FrameDisplay();
  ~FrameDisplay();
  FrameDisplay(const FrameDisplay&) = delete;
  FrameDisplay& operator=(const FrameDisplay&) = delete;

  /// Takes a new picture, 4 floats a pixel. Throws IoError if it is larger than the display can show.
  void upload(int width, int height, const std::vector<float>& rgba);
  /// Draws the frame into `where`, in pixels of the framebuffer, y down, as far as it is within `clip`; tone-maps first
  /// if frame or look are new.
  void draw(const Rect& where, int framebuffer_height, const Look& look, const Rect& clip);
  bool empty() const { return width_ == 0; }

 private:
  void resize(int width, int height);
  void tone_map(const Look& look);

  unsigned program_ = 0, vertices_ = 0, light_ = 0, bytes_ = 0, target_ = 0;
  int scale_at_ = -1, curve_at_ = -1, dither_at_ = -1, greatest_ = 0;
  int width_ = 0, height_ = 0;
  Look look_;
  bool fresh_ = false;
};

}  // namespace tyndall

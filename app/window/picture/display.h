#pragma once
#include "app/window/picture/look.h"
#include "app/window/system/layout.h"
#include "core/render/frame.h"

#include <vector>

namespace tyndall {

/// A picture to be shown: linear RGBA, 4 floats for each place of the grid, of an image of width x height pixels.
struct ShownPicture {
  const std::vector<float>& rgba;
  PictureGrid grid;
  int width = 0, height = 0;
};

/// Puts pictures on the screen with OpenGL 3.3, as a texture of the bytes that are shown. Lives within the window's
/// context.
class FrameDisplay {
 public:
  /// Throws IoError if the shaders do not compile.
  FrameDisplay();
  ~FrameDisplay();
  FrameDisplay(const FrameDisplay&) = delete;
  FrameDisplay& operator=(const FrameDisplay&) = delete;

  /// Takes a new picture, or another look at it. Throws IoError if it is larger than the display can show.
  void upload(const ShownPicture& picture, const Look& look);
  /// Draws the image into `where`, in pixels of the framebuffer, y down, as far as it is within `clip`. Between the
  /// places of a coarse picture colours are blended. squares: enlarged pixels are squares.
  void draw(const Rect& where, int framebuffer_width, int framebuffer_height, const Rect& clip, bool squares) const;

 private:
  unsigned program_ = 0, vertices_ = 0, texture_ = 0;
  int place_at_ = -1, part_at_ = -1, greatest_ = 0;
  PictureGrid grid_;
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace tyndall

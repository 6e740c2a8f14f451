#pragma once
#include "app/window/system/layout.h"
#include "core/render/frame.h"
#include "core/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

/// This room puts rendered pictures on the screen.
namespace tyndall {

/// A colour as the screen shows it, in [0, 1].
using ScreenColour = std::array<float, 3>;

/// Bands from -6 to +6: each holds what is nearer to its stop than to the next; the first and the last hold all that is
/// darker or brighter. Cold below middle grey, warm above, grey at it; the brightest is white.
inline constexpr std::array<ScreenColour, 13> stop_colours = {{{0.10f, 0.04f, 0.20f},
                                                               {0.22f, 0.08f, 0.45f},
                                                               {0.20f, 0.20f, 0.70f},
                                                               {0.12f, 0.42f, 0.80f},
                                                               {0.10f, 0.60f, 0.66f},
                                                               {0.16f, 0.66f, 0.40f},
                                                               {0.50f, 0.50f, 0.50f},
                                                               {0.62f, 0.76f, 0.24f},
                                                               {0.90f, 0.84f, 0.20f},
                                                               {0.96f, 0.64f, 0.16f},
                                                               {0.94f, 0.38f, 0.16f},
                                                               {0.84f, 0.14f, 0.18f},
                                                               {1.00f, 1.00f, 1.00f}}};
inline constexpr int darkest_stop = -6, brightest_stop = darkest_stop + static_cast<int>(stop_colours.size()) - 1;
inline constexpr float middle_grey = 0.18f;

/// How the picture is shown.
struct Look {
  double exposure = 0;  ///< stops
  ToneMap tone_map = ToneMap::srgb;
  bool dither = false;
  bool stops = false;  ///< luminance in colours, see stop_colours, in place of the curve
  bool operator==(const Look&) const = default;
};

/// What the screen shows of linear light, as a PNG of it would: `rgba` has 4 floats a pixel, of which the last is not
/// read, `bytes` gets 4, the last is 255. width: pixels a row.
void screen_bytes(const std::vector<float>& rgba, int width, const Look& look, std::vector<std::uint8_t>& bytes);

/// 3 of 4 floats a pixel.
std::vector<float> rgb_of(const std::vector<float>& rgba);

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

/// A picture that OpenGL holds. Lives within the window's context.
class PictureTexture {
 public:
  /// rgb: 3 bytes a pixel, top row first.
  PictureTexture(int width, int height, const std::vector<std::uint8_t>& rgb);
  ~PictureTexture();
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  unsigned number() const { return number_; }  ///< OpenGL's
  float width() const { return width_; }
  float height() const { return height_; }

 private:
  unsigned number_ = 0;
  float width_ = 0, height_ = 0;
};

/// The picture as large as its area allows, or enlarged and moved by the user.
class ImageZoom {
 public:
  /// Where the picture is, in window units; it may reach beyond the area. fit: where it is when all of it is shown;
  /// width, height: of the picture, in pixels; dots: pixels of the screen in a window unit.
  Rect place(const Rect& area, const Rect& fit, int width, int height, float dots);
  bool fits() const { return scale_ <= 0; }
  /// Pixels of the screen in one of the picture, as place() has shown it last.
  float dots_a_pixel() const { return shown_; }

  // Of the picture as place() has shown it last.

  /// Enlarges the picture by a factor, or makes it smaller, down to where all of it is shown, or to actual size where
  /// that is less; what is at (x, y) stays.
  void enlarge(float factor, float x, float y);
  void move(float dx, float dy);
  /// One pixel of the picture for each of the screen, what is at (x, y) stays; all of the picture if it is so.
  void toggle(float x, float y);
  void fit() { scale_ = 0; }

  static constexpr float maximum = 64;  ///< dots a pixel

 private:
  float scale_ = 0;                  ///< dots a pixel; 0: as the area allows
  float at_x_ = 0.5f, at_y_ = 0.5f;  ///< the point of the picture, as fractions of it, in the middle of the area
  float shown_ = 1, fit_ = 1;        ///< dots a pixel, now and when all is shown
  Rect image_, area_;                ///< as place() has found them
  void set(float scale, float x, float y);
  void limit();
};

/// The part of two rectangles that both cover; empty, with no width or height, where they do not meet.
Rect overlap(const Rect& a, const Rect& b);

}  // namespace tyndall

#pragma once
#include "app/window/system/layout.h"
#include "core/scene/scene.h"

#include <vector>

/// This room puts rendered pictures on the screen.
namespace tyndall {

/// How the picture is shown.
struct Look {
  double exposure = 0;  ///< stops
  ToneMap tone_map = ToneMap::srgb;
  bool dither = false;
  bool stops = false;   ///< luminance in colours, see stops.h, in place of the curve
  bool pixels = false;  ///< enlarged pixels are squares
  bool operator==(const Look&) const = default;
};

/// A picture to be shown: linear RGBA, 4 floats for each of columns x rows places. Place (x, y) is the middle of the
/// pixel (spacing x, spacing y) of an image of width x height pixels.
struct ShownPicture {
  const std::vector<float>& rgba;
  int columns = 0, rows = 0;
  float spacing = 1;
  int width = 0, height = 0;
};

/// Puts pictures on the screen with OpenGL 3.3: a float texture, tone-mapped once into a texture of bytes, which is all
/// that is copied while nothing new comes. Lives within the window's context.
class FrameDisplay {
 public:
  /// Throws IoError if the shaders do not compile.
  FrameDisplay();
  ~FrameDisplay();
  FrameDisplay(const FrameDisplay&) = delete;
  FrameDisplay& operator=(const FrameDisplay&) = delete;

  /// Takes a new picture. Throws IoError if it is larger than the display can show.
  void upload(const ShownPicture& picture);
  /// Tone-maps if picture or look are new. Before anything of the window is drawn: software that takes the place of a
  /// graphics card draws the window twice where another picture comes between.
  void prepare(const Look& look);
  /// Draws the image, prepared, into `where`, in pixels of the framebuffer, y down, as far as it is within `clip`.
  /// Between the places of a coarse picture colours are blended.
  void draw(const Rect& where, int framebuffer_height, const Rect& clip) const;
  bool empty() const { return shown_ == nullptr; }

 private:
  /// Textures for pictures of one size; whole and coarse pictures have their own, as they take turns.
  struct Surface {
    unsigned light = 0, bytes = 0, target = 0;
    int columns = 0, rows = 0;
  };
  void make(Surface& surface);
  void resize(Surface& surface, int columns, int rows) const;
  void tone_map(const Look& look);
  Rect place_of_picture(const Rect& where) const;
  void fill_rim(const Rect& where, const Rect& place, int framebuffer_height) const;

  unsigned program_ = 0, vertices_ = 0;
  Surface whole_, coarse_;
  Surface* shown_ = nullptr;
  float spacing_ = 1;
  int width_ = 0, height_ = 0;  ///< of the image
  int scale_at_ = -1, curve_at_ = -1, dither_at_ = -1, greatest_ = 0;
  Look look_;
  bool fresh_ = false;
};

}  // namespace tyndall

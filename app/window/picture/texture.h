#pragma once
#include <cstdint>
#include <vector>

/// Small pictures for the interface.
namespace tyndall {

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

}  // namespace tyndall

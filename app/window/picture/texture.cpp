#include "app/window/picture/texture.h"

#include <glad/gl.h>

#include <array>

namespace tyndall {

PictureTexture::PictureTexture(int width, int height, const std::vector<std::uint8_t>& rgb)
    : width_(static_cast<float>(width)), height_(static_cast<float>(height)) {
  glGenTextures(1, &number_);
  glBindTexture(GL_TEXTURE_2D, number_);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, name, GL_LINEAR);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

PictureTexture::~PictureTexture() { glDeleteTextures(1, &number_); }

}  // namespace tyndall

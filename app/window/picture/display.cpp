#include "app/window/picture/display.h"

#include "core/base/error.h"
#include "shaders.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tyndall {
namespace {

GLuint compile_shader(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char text[1024] = "";
  glGetShaderInfoLog(shader, sizeof text, nullptr, text);
  throw IoError(std::string("the display's shader does not compile: ") + text);
}

GLuint link_program() {
  const GLuint program = glCreateProgram();
  const GLuint parts[] = {compile_shader(GL_VERTEX_SHADER, display_vert),
                          compile_shader(GL_FRAGMENT_SHADER, display_frag)};
  for (const GLuint part : parts) glAttachShader(program, part);
  glLinkProgram(program);
  for (const GLuint part : parts) glDeleteShader(part);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw IoError("the display's shaders do not link");
  return program;
}

int whole(float v) { return static_cast<int>(std::lround(v)); }

}  // namespace

FrameDisplay::FrameDisplay() : program_(link_program()) {
  place_at_ = glGetUniformLocation(program_, "place");
  part_at_ = glGetUniformLocation(program_, "part");
  glGenVertexArrays(1, &vertices_);
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &greatest_);
}

FrameDisplay::~FrameDisplay() {
  glDeleteTextures(1, &texture_);
  glDeleteVertexArrays(1, &vertices_);
  glDeleteProgram(program_);
}

void FrameDisplay::upload(const ShownPicture& picture, const Look& look) {
  if (picture.grid.columns > greatest_ || picture.grid.rows > greatest_)
    throw IoError("the picture is larger than the display can show: " + std::to_string(picture.grid.columns) + "x" +
                  std::to_string(picture.grid.rows) + ", at most " + std::to_string(greatest_) + " pixels each way");
  screen_bytes(picture.rgba, picture.grid.columns, look, bytes_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (picture.grid.columns == grid_.columns && picture.grid.rows == grid_.rows)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, grid_.columns, grid_.rows, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
  else
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.grid.columns, picture.grid.rows, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 bytes_.data());
  grid_ = picture.grid;
  width_ = picture.width;
  height_ = picture.height;
}

void FrameDisplay::draw(const Rect& where, int framebuffer_width, int framebuffer_height, const Rect& clip,
                        bool squares) const {
  if (grid_.columns == 0 || where.width() < 1 || where.height() < 1) return;
  const int x0 = whole(where.x0), y0 = whole(where.y0), x1 = whole(where.x1), y1 = whole(where.y1);
  // Whole multiples show the pixels as they are.
  const bool multiple = (x1 - x0) % width_ == 0 && (y1 - y0) % height_ == 0;
  const GLint filter = grid_.spacing <= 1 && (multiple || squares) ? GL_NEAREST : GL_LINEAR;
  const Rect seen{std::max(clip.x0, where.x0), std::max(clip.y0, where.y0), std::min(clip.x1, where.x1),
                  std::min(clip.y1, where.y1)};
  glDisable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glScissor(whole(seen.x0), framebuffer_height - whole(seen.y1), std::max(0, whole(seen.x1) - whole(seen.x0)),
            std::max(0, whole(seen.y1) - whole(seen.y0)));
  glUseProgram(program_);
  const float across = 2 / static_cast<float>(framebuffer_width), down = 2 / static_cast<float>(framebuffer_height);
  glUniform4f(place_at_, static_cast<float>(x0) * across - 1, 1 - static_cast<float>(y0) * down,
              static_cast<float>(x1) * across - 1, 1 - static_cast<float>(y1) * down);
  // The first place of a coarse picture is in the middle of a pixel of the image, not of `spacing` pixels.
  const float columns = grid_.spacing * static_cast<float>(grid_.columns),
              rows = grid_.spacing * static_cast<float>(grid_.rows);
  const float first = 0.5f * (grid_.spacing - 1);
  glUniform4f(part_at_, first / columns, first / rows, (first + static_cast<float>(width_)) / columns,
              (first + static_cast<float>(height_)) / rows);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, name, filter);
  glBindVertexArray(vertices_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace tyndall

#include "app/window/system/display.h"

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

GLuint make_texture(GLint filter) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, name, filter);
  for (const GLenum name : std::array<GLenum, 2>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

FrameDisplay::FrameDisplay()
    : program_(link_program()), light_(make_texture(GL_NEAREST)), bytes_(make_texture(GL_LINEAR)) {
  scale_at_ = glGetUniformLocation(program_, "scale");
  curve_at_ = glGetUniformLocation(program_, "curve");
  dither_at_ = glGetUniformLocation(program_, "dither");
  glGenVertexArrays(1, &vertices_);
  glGenFramebuffers(1, &target_);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &greatest_);
}

FrameDisplay::~FrameDisplay() {
  glDeleteFramebuffers(1, &target_);
  glDeleteVertexArrays(1, &vertices_);
  glDeleteTextures(1, &light_);
  glDeleteTextures(1, &bytes_);
  glDeleteProgram(program_);
}

void FrameDisplay::resize(int width, int height) {
  if (width > greatest_ || height > greatest_)
    throw IoError("the picture is larger than the display can show: " + std::to_string(width) + "x" +
                  std::to_string(height) + ", at most " + std::to_string(greatest_) + " pixels each way");
  glBindTexture(GL_TEXTURE_2D, light_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  glBindTexture(GL_TEXTURE_2D, bytes_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, bytes_, 0);
  const bool whole = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!whole) throw IoError("the display cannot hold the picture");
  width_ = width;
  height_ = height;
}

void FrameDisplay::upload(int width, int height, const std::vector<float>& rgba) {
  if (width != width_ || height != height_) resize(width, height);
  glBindTexture(GL_TEXTURE_2D, light_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
  fresh_ = true;
}

void FrameDisplay::tone_map(const Look& look) {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, width_, height_);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(program_);
  glUniform1f(scale_at_, static_cast<float>(std::exp2(look.exposure)));
  glUniform1i(curve_at_, static_cast<int>(look.tone_map));
  glUniform1i(dither_at_, look.dither ? 1 : 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, light_);
  glBindVertexArray(vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  look_ = look;
  fresh_ = false;
}

void FrameDisplay::draw(const Rect& where, int framebuffer_height, const Look& look, const Rect& clip) {
  if (empty() || where.width() < 1 || where.height() < 1) return;
  if (fresh_ || !(look == look_)) tone_map(look);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_);
  const auto whole = [](float v) { return static_cast<int>(std::lround(v)); };
  const int x0 = whole(where.x0), x1 = whole(where.x1), top = framebuffer_height - whole(where.y0),
            bottom = framebuffer_height - whole(where.y1);
  // Whole multiples show the pixels as they are.
  const bool multiple = (x1 - x0) % width_ == 0 && (top - bottom) % height_ == 0;
  glEnable(GL_SCISSOR_TEST);
  glScissor(whole(clip.x0), framebuffer_height - whole(clip.y1), std::max(0, whole(clip.x1) - whole(clip.x0)),
            std::max(0, whole(clip.y1) - whole(clip.y0)));
  glBlitFramebuffer(0, 0, width_, height_, x0, top, x1, bottom, GL_COLOR_BUFFER_BIT, multiple ? GL_NEAREST : GL_LINEAR);
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace tyndall

#include "app/window/picture/display.h"

#include "app/window/picture/stops.h"
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

int whole(float v) { return static_cast<int>(std::lround(v)); }

/// Copies a part of the framebuffer that is read to a place in the window. from: x0, y0, x1, y1.
void copy(const std::array<int, 4>& from, const Rect& to, int framebuffer_height, GLenum filter) {
  glBlitFramebuffer(from[0], from[1], from[2], from[3], whole(to.x0), framebuffer_height - whole(to.y0), whole(to.x1),
                    framebuffer_height - whole(to.y1), GL_COLOR_BUFFER_BIT, filter);
}

}  // namespace

FrameDisplay::FrameDisplay() : program_(link_program()) {
  scale_at_ = glGetUniformLocation(program_, "scale");
  curve_at_ = glGetUniformLocation(program_, "curve");
  dither_at_ = glGetUniformLocation(program_, "dither");
  glUseProgram(program_);
  glUniform3fv(glGetUniformLocation(program_, "stops"), static_cast<int>(stop_colours.size()), &stop_colours[0].r);
  glGenVertexArrays(1, &vertices_);
  make(whole_);
  make(coarse_);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &greatest_);
}

FrameDisplay::~FrameDisplay() {
  for (const Surface* surface : {&whole_, &coarse_}) {
    glDeleteFramebuffers(1, &surface->target);
    glDeleteTextures(1, &surface->light);
    glDeleteTextures(1, &surface->bytes);
  }
  glDeleteVertexArrays(1, &vertices_);
  glDeleteProgram(program_);
}

void FrameDisplay::make(Surface& surface) {
  surface.light = make_texture(GL_NEAREST);
  surface.bytes = make_texture(GL_LINEAR);
  glGenFramebuffers(1, &surface.target);
}

void FrameDisplay::resize(Surface& surface, int columns, int rows) const {
  if (columns > greatest_ || rows > greatest_)
    throw IoError("the picture is larger than the display can show: " + std::to_string(columns) + "x" +
                  std::to_string(rows) + ", at most " + std::to_string(greatest_) + " pixels each way");
  glBindTexture(GL_TEXTURE_2D, surface.light);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, columns, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
  glBindTexture(GL_TEXTURE_2D, surface.bytes);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, surface.target);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, surface.bytes, 0);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) throw IoError("the display cannot hold the picture");
  surface.columns = columns;
  surface.rows = rows;
}

void FrameDisplay::upload(const ShownPicture& picture) {
  Surface& surface = picture.spacing > 1 ? coarse_ : whole_;
  if (picture.columns != surface.columns || picture.rows != surface.rows)
    resize(surface, picture.columns, picture.rows);
  glBindTexture(GL_TEXTURE_2D, surface.light);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, surface.columns, surface.rows, GL_RGBA, GL_FLOAT, picture.rgba.data());
  shown_ = &surface;
  spacing_ = picture.spacing;
  width_ = picture.width;
  height_ = picture.height;
  fresh_ = true;
}

void FrameDisplay::tone_map(const Look& look) {
  glBindFramebuffer(GL_FRAMEBUFFER, shown_->target);
  glViewport(0, 0, shown_->columns, shown_->rows);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(program_);
  glUniform1f(scale_at_, static_cast<float>(std::exp2(look.exposure)));
  glUniform1i(curve_at_, look.stops ? -1 : static_cast<int>(look.tone_map));
  glUniform1i(dither_at_, look.dither && !look.stops ? 1 : 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shown_->light);
  glBindVertexArray(vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  look_ = look;
  fresh_ = false;
}

/// Where the texture has to be drawn so that its places are over the pixels that they stand for.
Rect FrameDisplay::place_of_picture(const Rect& where) const {
  if (spacing_ <= 1) return where;
  const float across = where.width() / static_cast<float>(width_), down = where.height() / static_cast<float>(height_);
  const float first = 0.5f * (1 - spacing_);  // where the first place begins, in pixels of the image
  const float x0 = where.x0 + first * across, y0 = where.y0 + first * down;
  return {x0, y0, x0 + spacing_ * across * static_cast<float>(shown_->columns),
          y0 + spacing_ * down * static_cast<float>(shown_->rows)};
}

/// Beyond the last places of a coarse picture their colours go on to the edge of the image.
void FrameDisplay::fill_rim(const Rect& where, const Rect& place, int framebuffer_height) const {
  const int right = shown_->columns, bottom = shown_->rows;
  if (place.x1 < where.x1)
    copy({right - 1, 0, right, bottom}, {place.x1, place.y0, where.x1, place.y1}, framebuffer_height, GL_NEAREST);
  if (place.y1 < where.y1)
    copy({0, bottom - 1, right, bottom}, {place.x0, place.y1, std::max(place.x1, where.x1), where.y1},
         framebuffer_height, GL_NEAREST);
}

void FrameDisplay::prepare(const Look& look) {
  if (!empty() && (fresh_ || !(look == look_))) tone_map(look);
}

void FrameDisplay::draw(const Rect& where, int framebuffer_height, const Rect& clip) const {
  if (empty() || where.width() < 1 || where.height() < 1) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, shown_->target);
  const Rect place = place_of_picture(where);
  // Whole multiples show the pixels as they are.
  const bool multiple = spacing_ <= 1 && (whole(place.x1) - whole(place.x0)) % width_ == 0 &&
                        (whole(place.y1) - whole(place.y0)) % height_ == 0;
  const bool squares = multiple || (look_.pixels && spacing_ <= 1);
  const Rect seen{std::max(clip.x0, where.x0), std::max(clip.y0, where.y0), std::min(clip.x1, where.x1),
                  std::min(clip.y1, where.y1)};
  glEnable(GL_SCISSOR_TEST);
  glScissor(whole(seen.x0), framebuffer_height - whole(seen.y1), std::max(0, whole(seen.x1) - whole(seen.x0)),
            std::max(0, whole(seen.y1) - whole(seen.y0)));
  copy({0, 0, shown_->columns, shown_->rows}, place, framebuffer_height, squares ? GL_NEAREST : GL_LINEAR);
  if (spacing_ > 1) fill_rim(where, place, framebuffer_height);
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace tyndall

#include "app/window/picture/display.h"

#include "core/base/error.h"
#include "shaders.h"

#include <glad/gl.h>

#include <algorithm>
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

void screen_bytes(const std::vector<float>& rgba, int width, const Look& look, std::vector<std::uint8_t>& bytes) {
  if (!look.stops) return tone_map_rgba(rgba, look.exposure, look.tone_map, width, look.dither, bytes);
  using Pixel = std::array<std::uint8_t, 4>;
  std::array<Pixel, stop_colours.size()> pixels;
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(255 * v)); };
  std::transform(stop_colours.begin(), stop_colours.end(), pixels.begin(), [&](const ScreenColour& c) {
    return Pixel{byte(c[0]), byte(c[1]), byte(c[2]), 255};
  });
  const float gain = std::exp2(static_cast<float>(look.exposure));
  const auto light = [&](std::size_t i) { return rgba[i] > 0 ? std::min(gain * rgba[i], 1e30f) : 0.0f; };
  bytes.resize(rgba.size());
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const float luminance = 0.2126f * light(i) + 0.7152f * light(i + 1) + 0.0722f * light(i + 2);  // Rec.709
    const float band = std::floor(std::log2(luminance / middle_grey) + 0.5f) - darkest_stop;
    const Pixel pixel =
        luminance > 0 ? pixels[static_cast<std::size_t>(std::clamp(band, 0.0f, static_cast<float>(pixels.size() - 1)))]
                      : Pixel{0, 0, 0, 255};
    std::copy(pixel.begin(), pixel.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

std::vector<float> rgb_of(const std::vector<float>& rgba) {
  std::vector<float> rgb(rgba.size() / 4 * 3);
  for (std::size_t from = 0, to = 0; from < rgba.size(); from += 4, to += 3)
    for (std::size_t k = 0; k < 3; ++k) rgb[to + k] = rgba[from + k];
  return rgb;
}

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
  const int columns = picture.grid.columns, rows = picture.grid.rows;
  if (columns > greatest_ || rows > greatest_)
    throw IoError("the picture is larger than the display can show: " + std::to_string(columns) + "x" +
                  std::to_string(rows) + ", at most " + std::to_string(greatest_) + " pixels each way");
  screen_bytes(picture.rgba, columns, look, bytes_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (columns == grid_.columns && rows == grid_.rows)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, columns, rows, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
  else
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, columns, rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
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
  const Rect seen = overlap(clip, where);
  glDisable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glScissor(whole(seen.x0), framebuffer_height - whole(seen.y1), whole(seen.x1) - whole(seen.x0),
            whole(seen.y1) - whole(seen.y0));
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

Rect overlap(const Rect& a, const Rect& b) {
  const float x0 = std::max(a.x0, b.x0), y0 = std::max(a.y0, b.y0);
  return {x0, y0, std::max(x0, std::min(a.x1, b.x1)), std::max(y0, std::min(a.y1, b.y1))};
}

Rect ImageZoom::place(const Rect& area, const Rect& fit, int width, int height, float dots) {
  area_ = area, image_ = fit;
  fit_ = shown_ = fit.width() * dots / static_cast<float>(std::max(1, width));
  if (fits() || fit.width() <= 0) return image_;
  shown_ = scale_;
  const float w = static_cast<float>(width) * scale_ / dots, h = static_cast<float>(height) * scale_ / dots;
  // On whole pixels of the screen, so that at actual size each of the picture's is one of them.
  const auto rounded = [dots](float v) { return std::round(v * dots) / dots; };
  const float x0 = rounded((area.x0 + area.x1) / 2 - at_x_ * w), y0 = rounded((area.y0 + area.y1) / 2 - at_y_ * h);
  return image_ = {x0, y0, x0 + w, y0 + h};
}

/// What is at (x, y) now is there at the new scale, too. A picture that is smaller than the area goes to its middle.
void ImageZoom::set(float scale, float x, float y) {
  if (image_.width() <= 0 || image_.height() <= 0) return;
  const float u = (x - image_.x0) / image_.width(), v = (y - image_.y0) / image_.height();
  const float grown = scale / shown_, w = image_.width() * grown, h = image_.height() * grown;
  scale_ = scale;
  at_x_ = u + ((area_.x0 + area_.x1) / 2 - x) / w;
  at_y_ = v + ((area_.y0 + area_.y1) / 2 - y) / h;
  if (scale < fit_) at_x_ = at_y_ = 0.5f;
  limit();
}

/// The middle of the area always shows some of the picture, so that it cannot be lost.
void ImageZoom::limit() {
  at_x_ = std::clamp(at_x_, 0.0f, 1.0f);
  at_y_ = std::clamp(at_y_, 0.0f, 1.0f);
}

void ImageZoom::enlarge(float factor, float x, float y) {
  const float wanted = shown_ * factor, minimum = std::min(1.0f, fit_);
  if (wanted <= minimum * 1.001f && fit_ <= 1) return fit();
  set(std::clamp(wanted, minimum, std::max(maximum, fit_)), x, y);
}

void ImageZoom::move(float dx, float dy) {
  if (fits() || image_.width() <= 0) return;
  at_x_ -= dx / image_.width();
  at_y_ -= dy / image_.height();
  limit();
}

void ImageZoom::toggle(float x, float y) {
  if (!fits() && scale_ == 1) return fit();
  set(1, x, y);
}

}  // namespace tyndall

// The only file that compiles stb's functions for fonts. It reads fonts of the system alone.
#include "app/report/lettering.h"

#include "core/base/text.h"
#include "core/scene/load.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_easy_font.h>
#include <stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace tyndall {

struct Lettering::Font {
  std::vector<unsigned char> file;
  stbtt_fontinfo info{};
  float scale = 1;
  int ascent = 0;  ///< pixels from the top of a line to the letters' feet
};

namespace {

constexpr float easy_height = 12;  // of the built-in font, pixels

void blend(ScreenPicture& picture, int x, int y, SheetColour colour, int cover) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height || cover == 0) return;
  std::uint8_t* to = picture.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
  for (std::size_t c = 0; c < 3; ++c)
    to[c] = static_cast<std::uint8_t>((to[c] * (255 - cover) + colour[c] * cover + 127) / 255);
}

/// Calls draw(letter, x) for each letter; returns where the text ends. x: pixels.
template <class Draw>
float for_each_letter(const stbtt_fontinfo& info, float scale, const std::string& text, const Draw& draw) {
  float x = 0;
  int before = 0;
  for (std::size_t at = 0; at < text.size();) {
    const int letter = static_cast<int>(next_character(text, at));
    if (before) x += scale * static_cast<float>(stbtt_GetCodepointKernAdvance(&info, before, letter));
    draw(letter, x);
    int advance = 0;
    stbtt_GetCodepointHMetrics(&info, letter, &advance, nullptr);
    x += scale * static_cast<float>(advance);
    before = letter;
  }
  return x;
}

/// The built-in font has the letters of ASCII alone.
std::string plain(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const unsigned letter = next_character(text, at);
    out += letter == 0xb1     ? "+-"
           : letter == 0x2026 ? "..."
                              : std::string(1, letter < 0x7f ? static_cast<char>(letter) : '?');
  }
  return out;
}

/// The built-in font draws letters as rectangles.
void write_plain(ScreenPicture& picture, int left, int top, const std::string& text, SheetColour colour, float scale) {
  struct Corner {
    float x, y, z;
    unsigned char rgba[4];
  };
  std::string letters = plain(text);
  std::vector<Corner> corners(letters.size() * 70);
  const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  const auto pixel = [scale](float v) { return static_cast<int>(std::lround(v * scale)); };
  for (int q = 0; q < quads; ++q) {
    const std::size_t first = 4 * static_cast<std::size_t>(q);
    const Corner &low = corners[first], &high = corners[first + 2];
    for (int y = pixel(low.y); y < pixel(high.y); ++y)
      for (int x = pixel(low.x); x < pixel(high.x); ++x) blend(picture, left + x, top + y, colour, 255);
  }
}

}  // namespace

std::string find_font(const std::string& file) {
  static constexpr const char* folders[] = {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/",
                                            "/usr/share/fonts/truetype/jetbrains-mono/",
                                            "/usr/share/fonts/truetype/dejavu/",
                                            "/usr/share/fonts/TTF/",
                                            "/usr/share/fonts/google-roboto/",
                                            "/usr/share/fonts/jetbrains-mono-fonts/",
                                            "/usr/local/share/fonts/",
                                            "/Library/Fonts/",
                                            "C:/Windows/Fonts/"};
  std::error_code ignored;
  const std::filesystem::path packed = assets_folder() / "fonts" / file;  // where the system has none of them
  if (std::filesystem::is_regular_file(packed, ignored)) return packed.string();
  for (const std::string folder : folders)
    if (std::filesystem::is_regular_file(folder + file, ignored)) return folder + file;
  return "";
}

unsigned next_character(const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(at++);
  if (first < 0x80) return first;
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  unsigned code = more == 3 ? first & 0x07 : more == 2 ? first & 0x0f : first & 0x1f;
  for (int k = 0; k < more; ++k) {
    if ((byte(at) & 0xc0) != 0x80) return 0xfffd;
    code = (code << 6) | (byte(at++) & 0x3f);
  }
  return more == 0 ? 0xfffd : code;
}

Lettering::Lettering(int height) : height_(height) {
  for (const char* name : {"Roboto-Medium.ttf", "DejaVuSans.ttf", "Roboto-Regular.ttf"}) {
    const std::string path = find_font(name);
    if (path.empty()) continue;
    auto font = std::make_unique<Font>();
    std::ifstream in(path, std::ios::binary);
    font->file.assign(std::istreambuf_iterator<char>(in), {});
    if (font->file.empty() || !stbtt_InitFont(&font->info, font->file.data(), 0)) continue;
    int ascent = 0, descent = 0, line_gap = 0;
    stbtt_GetFontVMetrics(&font->info, &ascent, &descent, &line_gap);
    font->scale = static_cast<float>(height) / static_cast<float>(ascent - descent);
    font->ascent = static_cast<int>(std::lround(font->scale * static_cast<float>(ascent)));
    font_ = std::move(font);
    return;
  }
}

Lettering::~Lettering() = default;

int Lettering::width_of(const std::string& text) const {
  if (font_) return static_cast<int>(std::ceil(for_each_letter(font_->info, font_->scale, text, [](int, float) {})));
  std::string letters = plain(text);
  return static_cast<int>(
      std::ceil(static_cast<float>(stb_easy_font_width(letters.data())) * static_cast<float>(height_) / easy_height));
}

std::string Lettering::fitted(const std::string& text, int width) const {
  if (width_of(text) <= width) return text;
  std::size_t size = text.size();
  while (size > 0 && width_of(text.substr(0, size) + "…") > width) size = size_of_letters(text, size - 1);
  return text.substr(0, size) + "…";
}

void Lettering::write(ScreenPicture& picture, int left, int top, const std::string& text, SheetColour colour) const {
  if (!font_) return write_plain(picture, left, top, text, colour, static_cast<float>(height_) / easy_height);
  for_each_letter(font_->info, font_->scale, text, [&](int letter, float at) {
    int width = 0, height = 0, x0 = 0, y0 = 0;
    const float whole = std::floor(at);
    unsigned char* cover = stbtt_GetCodepointBitmapSubpixel(&font_->info, font_->scale, font_->scale, at - whole, 0,
                                                            letter, &width, &height, &x0, &y0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        blend(picture, left + static_cast<int>(whole) + x0 + x, top + font_->ascent + y0 + y, colour,
              cover[y * width + x]);
    stbtt_FreeBitmap(cover, nullptr);
  });
}

}  // namespace tyndall

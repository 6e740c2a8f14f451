// The only file that compiles stb's functions for fonts. It reads fonts of the system alone.
#include "app/report/contact_sheet.h"

#include "core/base/text.h"
#include "core/image/tonemap.h"
#include "core/scene/load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
namespace {

constexpr int max_sheet_width = 3840, min_cell_width = 240;
using Colour = std::array<std::uint8_t, 3>;
constexpr Colour paper{24, 26, 29}, ink{232, 234, 237}, pale_ink{150, 156, 163}, marker{240, 176, 64};

/// cover: how much of the pixel, in 1/255. What lies outside of the picture is left out.
void blend(ScreenPicture& picture, int x, int y, Colour colour, int cover = 255) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  std::uint8_t* to = picture.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
  for (std::size_t c = 0; c < 3; ++c)
    to[c] = static_cast<std::uint8_t>((to[c] * (255 - cover) + colour[c] * cover + 127) / 255);
}

void fill(ScreenPicture& picture, int x0, int y0, int x1, int y1, Colour colour) {
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) blend(picture, x, y, colour);
}

/// The built-in font has the letters of ASCII alone.
std::string plain(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t letter = next_letter(text, at);
    out += letter == 0xb1     ? "+-"
           : letter == 0x2026 ? "..."
                              : std::string(1, letter < 0x7f ? static_cast<char>(letter) : '?');
  }
  return out;
}

/// The built-in font draws letters as rectangles.
void write_plain(ScreenPicture& picture, int left, int top, std::string letters, Colour colour, float scale) {
  struct Corner {
    float x, y, z;
    unsigned char rgba[4];
  };
  std::vector<Corner> corners(letters.size() * 70);
  const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  const auto pixel = [scale](float v) { return static_cast<int>(std::lround(v * scale)); };
  for (std::size_t first = 0; first < 4 * static_cast<std::size_t>(quads); first += 4) {
    const Corner &low = corners[first], &high = corners[first + 2];
    fill(picture, left + pixel(low.x), top + pixel(low.y), left + pixel(high.x), top + pixel(high.y), colour);
  }
}

/// A font of the system in one size, or the built-in one.
class Lettering {
 public:
  /// height: of a line, pixels.
  explicit Lettering(int height) : scale_(static_cast<float>(height) / 12) {  // which is the height of the built-in one
    for (const char* name : {"Roboto-Medium.ttf", "DejaVuSans.ttf", "Roboto-Regular.ttf"}) {
      std::ifstream in(find_font(name), std::ios::binary);
      file_.assign(std::istreambuf_iterator<char>(in), {});
      if (!file_.empty() && stbtt_InitFont(&font_, file_.data(), 0)) break;
      file_.clear();
    }
    if (file_.empty()) return;
    int ascent = 0, descent = 0, line_gap = 0;
    stbtt_GetFontVMetrics(&font_, &ascent, &descent, &line_gap);
    scale_ = static_cast<float>(height) / static_cast<float>(ascent - descent);
    ascent_ = static_cast<int>(std::lround(scale_ * static_cast<float>(ascent)));
  }

  /// Writes the text, or its beginning and "…", in at most `width` pixels beside and below (left, top).
  void write(ScreenPicture& picture, int left, int top, const std::string& text, int width, Colour colour) const {
    std::string fitted = text;
    for (std::size_t size = text.size(); size > 0 && width_of(fitted) > static_cast<float>(width);)
      fitted = text.substr(0, size = size_of_letters(text, size - 1)) + "…";
    if (file_.empty()) return write_plain(picture, left, top, plain(fitted), colour, scale_);
    for_each_letter(fitted, [&](int letter, float at) {
      int columns = 0, rows = 0, x0 = 0, y0 = 0;
      const float whole = std::floor(at);
      unsigned char* cover =
          stbtt_GetCodepointBitmapSubpixel(&font_, scale_, scale_, at - whole, 0, letter, &columns, &rows, &x0, &y0);
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
          blend(picture, left + static_cast<int>(whole) + x0 + x, top + ascent_ + y0 + y, colour,
                cover[y * columns + x]);
      stbtt_FreeBitmap(cover, nullptr);
    });
  }

 private:
  float width_of(const std::string& text) const {
    if (!file_.empty()) return for_each_letter(text, [](int, float) {});
    return static_cast<float>(stb_easy_font_width(plain(text).data())) * scale_;
  }

  /// Calls draw(letter, x) for each letter; returns where the text ends. x: pixels.
  template <class Draw>
  float for_each_letter(const std::string& text, const Draw& draw) const {
    float x = 0;
    int before = 0;
    for (std::size_t at = 0; at < text.size();) {
      const int letter = static_cast<int>(next_letter(text, at));
      if (before) x += scale_ * static_cast<float>(stbtt_GetCodepointKernAdvance(&font_, before, letter));
      draw(letter, x);
      int advance = 0;
      stbtt_GetCodepointHMetrics(&font_, letter, &advance, nullptr);
      x += scale_ * static_cast<float>(advance);
      before = letter;
    }
    return x;
  }

  std::vector<unsigned char> file_{};  ///< of the font; empty: the built-in one
  stbtt_fontinfo font_{};
  float scale_;     ///< from the font's units to pixels
  int ascent_ = 0;  ///< pixels from the top of a line to the letters' feet
};

}  // namespace

std::string find_font(const std::string& file) {
  const std::string folders[] = {(assets_folder() / "fonts/").string(),  // where the system has none of them
                                 "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/",
                                 "/usr/share/fonts/truetype/jetbrains-mono/",
                                 "/usr/share/fonts/truetype/dejavu/",
                                 "/usr/share/fonts/TTF/",
                                 "/usr/share/fonts/google-roboto/",
                                 "/usr/share/fonts/jetbrains-mono-fonts/",
                                 "/usr/local/share/fonts/",
                                 "/Library/Fonts/",
                                 "C:/Windows/Fonts/"};
  std::error_code ignored;
  for (const std::string& folder : folders)
    if (std::filesystem::is_regular_file(folder + file, ignored)) return folder + file;
  return "";
}

Size sheet_cell(int width, int height, int columns) {
  const int max_width = std::max(1, max_sheet_width / columns);
  const int factor = std::max(1, std::min((min_cell_width + width - 1) / width, max_width / width));
  const int cell = std::min(width * factor, max_width);
  return {cell, std::max(1, static_cast<int>(std::lround(static_cast<double>(height) * cell / width)))};
}

int sheet_columns(int width, int height, int count) {
  int best = 1;
  double least = 1e300;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double shape = 1.0 * columns * width / (rows * (height + 0.2 * width));
    const double badness = std::abs(std::log(shape / 1.7)) + 0.15 * (rows * columns - count);
    if (badness < least) least = badness, best = columns;
  }
  return best;
}

ScreenPicture on_sheet(const LinearImage& image, const Display& display, Size cell) {
  std::vector<float> shown;
  shown.reserve(3 * static_cast<std::size_t>(cell.width) * static_cast<std::size_t>(cell.height));
  const auto at = [](int i, int of, int size) { return static_cast<int>(std::int64_t{i} * size / of); };
  for (int row = 0; row < cell.height; ++row)
    for (int column = 0; column < cell.width; ++column) {
      const int x0 = at(column, cell.width, image.width), y0 = at(row, cell.height, image.height);
      const int x1 = std::max(x0 + 1, at(column + 1, cell.width, image.width));
      const int y1 = std::max(y0 + 1, at(row + 1, cell.height, image.height));
      std::array<double, 3> sum{};
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const float* pixel = image.rgb.data() + 3 * (std::ptrdiff_t{y} * image.width + x);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(pixel[c]);
        }
      for (const double light : sum)
        shown.push_back(static_cast<float>(light / (static_cast<double>(x1 - x0) * (y1 - y0))));
    }
  return {cell.width, cell.height, tone_map(shown, display.exposure, display.tone_map)};
}

ScreenPicture contact_sheet(const std::vector<SheetPicture>& pictures, int columns, const std::string& heading,
                            const std::string& note) {
  const int width = pictures.front().picture.width, height = pictures.front().picture.height;
  const int gap = std::clamp(width / 24, 10, 28), title_height = std::clamp(width / 16, 17, 34),
            detail_height = std::clamp(width / 20, 14, 26), thickness = std::max(2, gap / 8);
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  const int head = title_height + detail_height + 2 * gap, cell_height = height + gap / 2 + head - gap;
  ScreenPicture sheet{gap + columns * (width + gap), head + rows * cell_height + gap / 2, {}};
  sheet.rgb.resize(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
  fill(sheet, 0, 0, sheet.width, sheet.height, paper);
  const Lettering title(title_height), detail(detail_height);
  title.write(sheet, gap, gap, heading, sheet.width - 2 * gap, ink);
  detail.write(sheet, gap, gap + title_height + gap / 4, note, sheet.width - 2 * gap, pale_ink);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const SheetPicture& one = pictures[i];
    const int left = gap + static_cast<int>(i) % columns * (width + gap);
    const int top = head + static_cast<int>(i) / columns * cell_height, line = top + height + gap / 2;
    if (one.marked)
      fill(sheet, left - thickness, top - thickness, left + width + thickness, top + height + thickness, marker);
    for (int y = 0; y < height; ++y)
      std::copy_n(one.picture.rgb.begin() + 3 * std::ptrdiff_t{y} * width, 3 * width,
                  sheet.rgb.begin() + 3 * (std::ptrdiff_t{top + y} * sheet.width + left));
    title.write(sheet, left, line, one.title, width, ink);
    detail.write(sheet, left, line + title_height, one.detail, width, pale_ink);
  }
  return sheet;
}

LinearImage light_of(const ScreenPicture& picture) {
  LinearImage image{picture.width, picture.height, {}};
  image.rgb.reserve(picture.rgb.size());
  for (const std::uint8_t value : picture.rgb) image.rgb.push_back(srgb_decode(static_cast<float>(value) / 255));
  return image;
}

}  // namespace tyndall

#include "app/report/contact_sheet.h"

#include "core/image/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

constexpr int max_sheet_width = 3840, min_cell_width = 240;
constexpr SheetColour paper{24, 26, 29}, ink{232, 234, 237}, pale_ink{150, 156, 163}, marker{240, 176, 64};

ScreenPicture blank(int width, int height) {
  ScreenPicture picture{width, height, {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = paper[i % 3];
  return picture;
}

void copy(const ScreenPicture& from, ScreenPicture& to, int left, int top) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * from.width, 3 * from.width,
                to.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * to.width + left));
}

void frame(ScreenPicture& picture, int left, int top, int width, int height, int thickness) {
  for (int y = top - thickness; y < top + height + thickness; ++y)
    for (int x = left - thickness; x < left + width + thickness; ++x) {
      const bool inside = x >= left && x < left + width && y >= top && y < top + height;
      if (inside || x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
      std::copy(marker.begin(), marker.end(),
                picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
    }
}

/// The mean of the light in a rectangle of pixels.
std::array<double, 3> mean_light(const LinearImage& image, int x0, int y0, int x1, int y1) {
  std::array<double, 3> sum{};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] +=
            static_cast<double>(image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                               static_cast<std::size_t>(x)) +
                                          c]);
  for (double& value : sum) value /= static_cast<double>(x1 - x0) * (y1 - y0);
  return sum;
}

}  // namespace

Size sheet_cell(int width, int height, int columns) {
  const int max_width = std::max(1, max_sheet_width / columns);
  if (width >= min_cell_width || max_width < 2 * width) {
    const int cell = std::min(width, max_width);
    return {cell, std::max(1, static_cast<int>(std::lround(static_cast<double>(height) * cell / width)))};
  }
  const int factor = std::min((min_cell_width + width - 1) / width, max_width / width);
  return {width * factor, height * factor};
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
  LinearImage shown{cell.width, cell.height, {}};
  shown.rgb.reserve(3 * static_cast<std::size_t>(cell.width) * static_cast<std::size_t>(cell.height));
  const auto at = [](int i, int of, int size) { return static_cast<int>(std::int64_t{i} * size / of); };
  for (int y = 0; y < cell.height; ++y)
    for (int x = 0; x < cell.width; ++x) {
      const int x0 = at(x, cell.width, image.width), y0 = at(y, cell.height, image.height);
      const int x1 = std::max(x0 + 1, at(x + 1, cell.width, image.width));
      const int y1 = std::max(y0 + 1, at(y + 1, cell.height, image.height));
      for (const double value : mean_light(image, x0, y0, x1, y1)) shown.rgb.push_back(static_cast<float>(value));
    }
  return {cell.width, cell.height, tone_map(shown.rgb, display.exposure, display.tone_map)};
}

ScreenPicture contact_sheet(const std::vector<SheetPicture>& pictures, int columns, const std::string& heading,
                            const std::string& note) {
  const ScreenPicture& first = pictures.front().picture;
  const int gap = std::clamp(first.width / 24, 10, 28), title_height = std::clamp(first.width / 16, 17, 34),
            detail_height = std::clamp(first.width / 20, 14, 26);
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  const int head = title_height + detail_height + 2 * gap, cell_height = first.height + gap / 2 + head - gap;
  ScreenPicture sheet = blank(gap + columns * (first.width + gap), head + rows * cell_height + gap / 2);
  const Lettering title(title_height), detail(detail_height);
  const int whole = sheet.width - 2 * gap;
  title.write(sheet, gap, gap, title.fitted(heading, whole), ink);
  detail.write(sheet, gap, gap + title_height + gap / 4, detail.fitted(note, whole), pale_ink);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const SheetPicture& one = pictures[i];
    const int x = gap + static_cast<int>(i) % columns * (first.width + gap);
    const int y = head + static_cast<int>(i) / columns * cell_height;
    copy(one.picture, sheet, x, y);
    if (one.marked) frame(sheet, x, y, first.width, first.height, std::max(2, gap / 8));
    const int line = y + first.height + gap / 2;
    title.write(sheet, x, line, title.fitted(one.title, first.width), ink);
    detail.write(sheet, x, line + title_height, detail.fitted(one.detail, first.width), pale_ink);
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

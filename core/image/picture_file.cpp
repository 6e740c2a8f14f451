#include "core/image/picture_file.h"

#include "core/base/text.h"
#include "core/image/tonemap.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

double power_of_exponent(double exponent) {
  constexpr double usual = 0.45455;  // as PNG's gAMA writes 1 / 2.2
  return std::abs(exponent / usual - 1) <= 0.05 ? srgb_curve : 1 / exponent;
}

std::vector<float> light_table(unsigned largest, double power) {
  std::vector<float> light;
  light.reserve(largest + 1);
  for (unsigned number = 0; number <= largest; ++number) {
    const float part = static_cast<float>(number) / static_cast<float>(largest);
    light.push_back(power == srgb_curve ? srgb_decode(part)
                                        : static_cast<float>(std::pow(static_cast<double>(part), power)));
  }
  return light;
}

PictureFile picture_of(const Samples& samples, double power) {
  const std::vector<float> light = light_table(samples.largest, power);
  const std::size_t size = samples.largest > 255 ? 2 : 1, step = size * samples.channels;
  const auto number = [&](std::size_t at) -> unsigned {
    return size == 1 ? samples.bytes[at] : samples.bytes[at] * 256u + samples.bytes[at + 1];
  };
  PictureFile picture;
  picture.bits = size == 1 ? 8 : 16;
  picture.image.width = samples.width, picture.image.height = samples.height;
  picture.image.rgb.reserve(samples.bytes.size() / step * 3);
  for (std::size_t at = 0; at < samples.bytes.size(); at += step) {
    for (std::size_t c = 0; c < 3; ++c) picture.image.rgb.push_back(light[number(at + c * size)]);
    if (samples.channels == 4 && number(at + 3 * size) < samples.largest) picture.has_alpha = true;
  }
  return picture;
}

std::uint32_t low_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i) value |= std::uint32_t{bytes[at + i]} << 8 * i;
  return value;
}

void add_remark(PictureFile& picture, const std::filesystem::path& file, const std::string& text) {
  picture.remarks.push_back(file.string() + ": " + printable(text));
}

LinearImage oriented(LinearImage stored, const Orientation& orientation) {
  if (orientation == Orientation{}) return stored;
  const auto columns = static_cast<std::size_t>(stored.width), rows = static_cast<std::size_t>(stored.height);
  const std::size_t width = orientation.columns ? rows : columns, height = orientation.columns ? columns : rows;
  LinearImage picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.rgb.reserve(stored.rgb.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t across = orientation.from_right ? width - 1 - x : x;
      const std::size_t down = orientation.from_bottom ? height - 1 - y : y;
      const std::size_t pixel = orientation.columns ? across * columns + down : down * columns + across;
      picture.rgb.insert(picture.rgb.end(), &stored.rgb[3 * pixel], &stored.rgb[3 * pixel] + 3);
    }
  return picture;
}

Orientation exif_orientation(std::span<const std::uint8_t> tiff) {
  if (tiff.size() < 8 || tiff[0] != tiff[1] || (tiff[0] != 'I' && tiff[0] != 'M')) return {};
  const auto number = [&](std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | tiff[at + (tiff[0] == 'M' ? i : size - 1 - i)];
    return value;
  };
  const std::size_t directory = number(4, 4);
  if (directory > tiff.size() - 2) return {};
  const std::size_t count = std::min(number(directory, 2), (tiff.size() - directory - 2) / 12);
  for (std::size_t entry = 0; entry < count; ++entry) {
    const std::size_t at = directory + 2 + 12 * entry;
    if (number(at, 2) != 0x0112) continue;
    const std::size_t value = number(at + 8, 2);  // 1 to 8; the tag is a number of 2 bytes
    const bool from_right = value == 2 || value == 3 || value == 6 || value == 7;
    const bool from_bottom = value == 3 || value == 4 || value == 7 || value == 8;
    return {value >= 5 && value <= 8, from_right, from_bottom};
  }
  return {};
}

}  // namespace tyndall

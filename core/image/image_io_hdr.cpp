#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/whole_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall {

namespace {

constexpr float largest_rgbe = 0x1.fcp126f;  // the largest that rounding keeps within the exponent byte

/// The nearest value that RGBE can hold: 0 for negative values and what is not a number, the largest for infinity.
float in_range(float value) { return value > 0 ? std::min(value, largest_rgbe) : 0.0f; }

/// A pixel's channels share the exponent of the largest, with 8 bits each. The encoder cuts the rest off, which would
/// darken the image by a quarter of a percent: adding half a step makes it round.
void prepare_pixel(float* rgb) {
  for (int i = 0; i < 3; ++i) rgb[i] = in_range(rgb[i]);
  int exponent = 0;
  if (std::frexp(std::max({rgb[0], rgb[1], rgb[2]}), &exponent) == 0) return;
  for (int i = 0; i < 3; ++i) rgb[i] += std::ldexp(1.0f, exponent - 9);
}

}  // namespace

void write_hdr(const std::filesystem::path& file, const LinearImage& image) {
  check_writable(file, image);
  std::vector<float> rgb = image.rgb;
  for (std::size_t i = 0; i < rgb.size(); i += 3) prepare_pixel(&rgb[i]);
  const std::vector<std::uint8_t> bytes = encode_hdr(image.width, image.height, rgb.data());
  WholeFile out(file);
  out.write(bytes);
  out.commit();
}

namespace {

[[noreturn]] void damaged(const std::filesystem::path& file, const char* what) {
  cannot_read(file, std::string("damaged: ") + what);
}

/// Skips the header (lines of text, an empty line, and a line with the size) and returns the bytes after it.
/// G. Ward: Radiance, File Formats (picture files).
struct HdrReader {
  const std::filesystem::path& file;
  std::span<const std::uint8_t> bytes;

  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > bytes.size()) damaged(file, "the HDR ends in the middle");
    const auto taken = bytes.first(count);
    bytes = bytes.subspan(count);
    return taken;
  }
  std::string take_line() {
    const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{'\n'});
    const auto line = take(static_cast<std::size_t>(end - bytes.begin()));
    take(1);
    return {line.begin(), line.end()};
  }
  /// One channel of a row: runs (a count above 128 and a byte) and copies (a count and bytes).
  void take_runs(std::uint8_t* channel, std::size_t width) {
    for (std::size_t x = 0; x < width;) {
      const std::size_t code = take(1)[0], count = code > 128 ? code - 128 : code;
      if (count == 0 || count > width - x) damaged(file, "a row of the HDR does not fit");
      const auto values = take(code > 128 ? 1 : count);
      for (std::size_t i = 0; i < count; ++i, ++x) channel[4 * x] = values[code > 128 ? 0 : i];
    }
  }
  /// A row of width pixels of 4 bytes, run by run or plain.
  void take_row(std::vector<std::uint8_t>& row, std::size_t width) {
    const bool runs = width >= 8 && width < 32768 && bytes.size() >= 4 && bytes[0] == 2 && bytes[1] == 2 &&
                      bytes[2] == width >> 8 && bytes[3] == (width & 255);
    if (runs) {
      take(4);
      for (std::size_t channel = 0; channel < 4; ++channel) take_runs(row.data() + channel, width);
    } else {
      const auto plain = take(4 * width);
      std::copy(plain.begin(), plain.end(), row.begin());
    }
  }
};

/// The fewest bytes that rows of this width can have: 4 for each pixel where runs are not allowed, else a mark of 4 and
/// 2 for each run of 127 pixels of each of 4 channels.
std::uint64_t least_hdr_bytes(int width, int height) {
  const auto columns = static_cast<std::uint64_t>(width), rows = static_cast<std::uint64_t>(height);
  return rows * (width < 8 || width >= 32768 ? 4 * columns : 4 + 8 * (columns / 127));
}

void put_row(std::vector<float>& rgb, const std::vector<std::uint8_t>& row) {
  for (std::size_t x = 0; x < row.size(); x += 4) {
    for (std::size_t i = 0; i < 3; ++i) {
      rgb.push_back(row[x + 3] == 0 ? 0 : std::ldexp(static_cast<float>(row[x + i]), row[x + 3] - 136));
    }
  }
}

}  // namespace

LinearImage read_hdr(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  HdrReader reader{file, bytes};
  bool rgbe = false;
  for (std::string line = reader.take_line(); !line.empty(); line = reader.take_line()) {
    rgbe = rgbe || line == "FORMAT=32-bit_rle_rgbe";
  }
  if (!rgbe) cannot_read(file, "expected an HDR of format 32-bit_rle_rgbe");
  LinearImage image;
  if (std::sscanf(reader.take_line().c_str(), "-Y %9d +X %9d", &image.height, &image.width) != 2) {
    cannot_read(file, "expected an HDR from the top left, row by row (-Y height +X width)");
  }
  check_readable(file, image.width, image.height);
  check_enough(file, reader.bytes.size(), least_hdr_bytes(image.width, image.height));
  std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    reader.take_row(row, static_cast<std::size_t>(image.width));
    put_row(image.rgb, row);
  }
  return image;
}

}  // namespace tyndall

#include "core/image/image_io.h"

#include "core/base/text.h"
#include "core/image/image_io_file.h"
#include "core/image/whole_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tyndall {
namespace {

constexpr float largest_rgbe = 0x1.fcp126f;  // the largest that rounding keeps within the exponent byte

/// A pixel becomes the nearest that RGBE can hold: 0 for negative values and what is not a number, the largest for
/// infinity. Its channels share the exponent of the largest, with 8 bits each. The encoder cuts the rest off, which
/// would darken the image by a quarter of a percent: adding half a step makes it round.
void prepare_pixel(float* rgb) {
  for (int i = 0; i < 3; ++i) rgb[i] = rgb[i] > 0 ? std::min(rgb[i], largest_rgbe) : 0.0f;
  int exponent = 0;
  if (std::frexp(std::max({rgb[0], rgb[1], rgb[2]}), &exponent) == 0) return;
  for (int i = 0; i < 3; ++i) rgb[i] += std::ldexp(1.0f, exponent - 9);
}

[[noreturn]] void damaged(const std::filesystem::path& file, const char* what) {
  cannot_read(file, std::string("damaged: ") + what);
}

/// Takes the parts of a picture one after the other: the header (lines of text, an empty line, and a line with the
/// size), and rows. G. Ward: Radiance, File Formats (picture files).
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
    const bool carriage_return = !line.empty() && line.back() == '\r';
    return {line.begin(), line.end() - (carriage_return ? 1 : 0)};
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
  /// A row of pixels of 4 bytes, run by run or plain.
  void take_row(std::vector<std::uint8_t>& row) {
    const std::size_t width = row.size() / 4;
    const bool runs = width >= 8 && width < 32768 && bytes.size() >= 4 && bytes[0] == 2 && bytes[1] == 2 &&
                      bytes[2] == width >> 8 && bytes[3] == (width & 255);
    if (runs) {
      take(4);
      for (std::size_t channel = 0; channel < 4; ++channel) take_runs(row.data() + channel, width);
    } else {
      const auto plain = take(row.size());
      // A pixel of 1, 1, 1 is none: it is the sign of the runs of the format's first version.
      for (std::size_t x = 0; x < plain.size(); x += 4)
        if (plain[x] == 1 && plain[x + 1] == 1 && plain[x + 2] == 1)
          cannot_read(file, "found an HDR with runs of the old kind, expected plain rows or the runs of today");
      std::copy(plain.begin(), plain.end(), row.begin());
    }
  }
};

/// The fewest bytes that rows of this width can have: 4 for each pixel where runs are not allowed, else a mark of 4 and
/// 2 for each run of 127 pixels of each of 4 channels.
std::uint64_t min_hdr_bytes(int width, int height) {
  const auto columns = static_cast<std::uint64_t>(width), rows = static_cast<std::uint64_t>(height);
  return rows * (width < 8 || width >= 32768 ? 4 * columns : 4 + 8 * (columns / 127));
}

/// What a header says of the pixels. Lines that begin with white space are those of pictures that this one was made of.
struct HdrHeader {
  const std::filesystem::path& file;
  bool rgbe = false;
  std::array<double, 3> factors{1, 1, 1};  ///< by which light was multiplied: the product of all such lines

  /// The numbers behind "KEY=".
  template <std::size_t count>
  std::array<double, count> numbers(const std::string& line) const {
    std::array<double, count> values{};
    std::size_t start = line.find('=') + 1;
    for (double& value : values) {
      start = std::min(line.find_first_not_of(" \t", start), line.size());
      const std::size_t end = std::min(line.find_first_of(" \t", start), line.size());
      if (!number_from_text(std::string_view(line).substr(start, end - start), value))
        cannot_read(file, "found " + in_quotes(line) + ", expected " + std::to_string(count) + " numbers");
      start = end;
    }
    return values;
  }

  void multiply(const std::string& line, const std::array<double, 3>& by) {
    for (std::size_t i = 0; i < 3; ++i) {
      factors[i] *= by[i];
      if (!(factors[i] > 0) || !std::isfinite(factors[i]))
        cannot_read(file, "found " + in_quotes(line) + ", expected numbers above 0");
    }
  }

  /// Red, green, blue and white as x and y: those of Rec.709, or Radiance's own, which stand for them here.
  void check_primaries(const std::string& line) const {
    constexpr std::array<double, 8> rec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    constexpr std::array<double, 8> radiance{0.64, 0.33, 0.29, 0.60, 0.15, 0.06, 0.3333, 0.3333};
    const auto found = numbers<8>(line);
    const auto is_near = [&](const std::array<double, 8>& known) {
      return std::equal(found.begin(), found.end(), known.begin(),
                        [](double a, double b) { return std::abs(a - b) <= 0.002; });
    };
    if (!is_near(rec709) && !is_near(radiance))
      cannot_read(file, "found " + in_quotes(line) + ", expected the primaries of Rec.709");
  }

  void read(const std::string& line) {
    if (line.starts_with("FORMAT=")) {
      rgbe = line.ends_with("32-bit_rle_rgbe") && line.find_first_not_of(" \t", 7) == line.size() - 15;
      if (!rgbe) cannot_read(file, "found " + in_quotes(line) + ", expected FORMAT=32-bit_rle_rgbe");
    } else if (line.starts_with("EXPOSURE=")) {
      const double factor = numbers<1>(line)[0];
      multiply(line, {factor, factor, factor});
    } else if (line.starts_with("COLORCORR=")) {
      multiply(line, numbers<3>(line));
    } else if (line.starts_with("GAMMA=")) {
      if (numbers<1>(line)[0] != 1) cannot_read(file, "found " + in_quotes(line) + ", expected GAMMA=1, light itself");
    } else if (line.starts_with("PRIMARIES=")) {
      check_primaries(line);
    }
  }
};

/// "-Y 480 +X 640": 480 rows from the top, each of 640 pixels from the left. With X first the rows are columns.
std::pair<LinearImage, Orientation> read_size_line(const std::filesystem::path& file, const std::string& line) {
  int rows = 0, columns = 0;
  char signs[2] = {}, axes[2] = {}, rest = 0;
  const int read = std::sscanf(line.c_str(), " %c%c %9d %c%c %9d %c", &signs[0], &axes[0], &rows, &signs[1], &axes[1],
                               &columns, &rest);
  const bool known = read == 6 && (signs[0] == '-' || signs[0] == '+') && (signs[1] == '-' || signs[1] == '+') &&
                     ((axes[0] == 'Y' && axes[1] == 'X') || (axes[0] == 'X' && axes[1] == 'Y'));
  if (!known) cannot_read(file, "found " + in_quotes(line) + ", expected the size of an HDR, such as -Y 480 +X 640");
  check_readable(file, columns, rows);
  const bool x_first = axes[0] == 'X';
  return {{columns, rows, {}}, {x_first, signs[x_first ? 0 : 1] == '-', signs[x_first ? 1 : 0] == '+'}};
}

}  // namespace

void write_hdr(const std::filesystem::path& file, const LinearImage& image) {
  check_writable(file, image);
  std::vector<float> rgb = image.rgb;
  for (std::size_t i = 0; i < rgb.size(); i += 3) prepare_pixel(&rgb[i]);
  const std::vector<std::uint8_t> bytes = encode_hdr(image.width, image.height, rgb.data());
  WholeFile out(file);
  out.write(std::as_bytes(std::span(bytes)));
  out.commit();
}

PictureFile read_hdr(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  HdrReader reader{file, bytes};
  HdrHeader header{file};
  for (std::string line = reader.take_line(); !line.empty(); line = reader.take_line()) header.read(line);
  if (!header.rgbe) cannot_read(file, "found no line FORMAT=32-bit_rle_rgbe in the header of the HDR");
  auto [stored, orientation] = read_size_line(file, reader.take_line());
  check_enough(file, reader.bytes.size(), min_hdr_bytes(stored.width, stored.height));
  std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(stored.width));
  for (int y = 0; y < stored.height; ++y) {
    reader.take_row(row);
    for (std::size_t x = 0; x < row.size(); x += 4)
      for (std::size_t i = x; i < x + 3; ++i)
        stored.rgb.push_back(row[x + 3] == 0 ? 0 : std::ldexp(static_cast<float>(row[i]), row[x + 3] - 136));
  }
  if (header.factors != std::array<double, 3>{1, 1, 1})
    for (std::size_t i = 0; i < stored.rgb.size(); ++i)
      stored.rgb[i] = static_cast<float>(static_cast<double>(stored.rgb[i]) / header.factors[i % 3]);
  PictureFile picture;
  picture.image = oriented(std::move(stored), orientation);
  return picture;
}

}  // namespace tyndall

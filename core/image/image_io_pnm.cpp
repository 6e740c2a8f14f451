#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/pnm_reader.h"
#include "core/image/whole_file.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace tyndall {
namespace {

/// Believes the size that a header says only where the file is long enough for it. left: bytes behind the header.
void check_length(const std::filesystem::path& file, const PnmHeader& header, std::size_t left) {
  const std::size_t needed = header.is_text() ? 2 * header.numbers() : 1 + header.numbers() * header.number_size();
  if (left < needed)
    cannot_read(file, "damaged: found " + std::to_string(left) + " bytes behind the header, expected at least " +
                          std::to_string(needed) + " for " + std::to_string(header.width) + " x " +
                          std::to_string(header.height) + " pixels");
}

struct PfmHeader {
  int width = 0, height = 0;
  std::size_t channels = 3;
  double scale = -1;    ///< negative: little endian
  std::size_t end = 0;  ///< behind the last word
  std::size_t pixels() const {
    return channels * sizeof(float) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

PfmHeader read_header(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  PfmHeader header;
  const auto begin = bytes.first(std::min<std::size_t>(bytes.size(), 256));
  char kind = 0, scale[256] = "";
  int end = 0;
  const int read = std::sscanf(std::string(begin.begin(), begin.end()).c_str(), "P%c %9d %9d %255s%n", &kind,
                               &header.width, &header.height, scale, &end);
  if (read != 4 || !number_from_text(scale, header.scale) || header.scale == 0 || !std::isfinite(header.scale))
    cannot_read(file, "damaged: expected a PFM header: PF, width, height, scale");
  check_readable(file, header.width, header.height);
  header.channels = kind == 'F' ? 3 : 1;
  header.end = static_cast<std::size_t>(end);
  return header;
}

float read_float(const std::uint8_t* bytes, bool swap) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return std::bit_cast<float>(swap ? __builtin_bswap32(word) : word);
}

/// Where the pixels begin after a header in text, whose last word ends at `end`: behind one character of white space,
/// or two where a program wrote CR LF and the file is long enough for it. pixels: how many bytes the pixels have.
std::size_t pixels_after(std::span<const std::uint8_t> bytes, std::size_t end, std::size_t pixels) {
  const bool two = end + 1 < bytes.size() && bytes[end] == '\r' && bytes[end + 1] == '\n';
  const std::size_t start = std::min(end + 1, bytes.size());
  return two && bytes.size() - start > pixels ? start + 1 : start;
}

/// Throws unless nothing but white space follows a picture: a further picture or bytes that nobody asked for mean that
/// the file is not what its header says. after: what follows; magic: how a further picture would begin.
void check_end(const std::filesystem::path& file, std::span<const std::uint8_t> after, std::string_view magic) {
  const std::string_view text(reinterpret_cast<const char*>(after.data()), after.size());
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  if (first == text.end()) return;
  if (text.substr(static_cast<std::size_t>(first - text.begin())).starts_with(magic))
    cannot_read(file, "found several pictures in one file, expected one");
  cannot_read(file, "found " + std::to_string(after.size()) + " bytes after the last pixel, expected none");
}

}  // namespace

void write_ppm(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               PpmCurve ppm, std::optional<DitherOrigin> dither) {
  check_writable(file, image);
  const std::string header = "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  const std::vector<std::uint8_t> pixels = ppm == PpmCurve::gamma2
                                               ? gamma2_bytes(image.rgb, exposure, curve)
                                               : tone_map(image.rgb, exposure, curve, image.width, dither);
  WholeFile out(file);
  out.write(std::as_bytes(std::span(header)));
  out.write(std::as_bytes(std::span(pixels)));
  out.commit();
}

PictureFile read_ppm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, PpmCurve curve) {
  PnmReader reader(file, curve, bytes.size());
  PictureFile picture;
  std::vector<float>& rgb = picture.image.rgb;
  std::size_t at = reader.take(bytes, rgb, true);
  if (!reader.header()) reader.end(rgb);
  const std::string ends = std::string("damaged: the file ends where ") + reader.expected() + " is expected";
  if (!reader.header()) cannot_read(file, ends);
  const PnmHeader& header = *reader.header();
  check_length(file, header, bytes.size() - at);
  picture.image.width = static_cast<int>(header.width), picture.image.height = static_cast<int>(header.height);
  picture.bits = header.largest > 255 ? 16 : 8;
  rgb.reserve(std::size_t{3} * static_cast<std::size_t>(header.width * header.height));
  at += reader.take(bytes.subspan(at), rgb);
  reader.end(rgb);
  if (!reader.whole())
    cannot_read(file, header.is_text() ? "damaged: the file ends where a colour is expected"
                                       : "damaged: the PPM ends in the middle");
  check_end(file, bytes.subspan(at), header.is_text() ? "P" : std::string("P") + header.kind);
  if (const auto remark = reader.remark()) add_remark(picture, file, *remark);
  return picture;
}

static_assert(std::endian::native == std::endian::little, "PFM is written as it is in memory");

void write_pfm(const std::filesystem::path& file, const LinearImage& image) {
  check_writable(file, image);
  const std::string header = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  const auto row = 3 * static_cast<std::size_t>(image.width);
  WholeFile out(file);
  out.write(std::as_bytes(std::span(header)));
  for (std::size_t left = image.rgb.size(); left > 0; left -= row)
    out.write(std::as_bytes(std::span(image.rgb).subspan(left - row, row)));
  out.commit();
}

PictureFile read_pfm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const PfmHeader header = read_header(file, bytes);
  const auto pixels = bytes.subspan(pixels_after(bytes, header.end, header.pixels()));
  if (pixels.size() < header.pixels()) cannot_read(file, "damaged: the PFM ends in the middle");
  check_end(file, pixels.subspan(header.pixels()), "P");
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  PictureFile picture;
  LinearImage& image = picture.image;
  image.width = header.width, image.height = header.height;
  image.rgb.reserve(width * height * 3);
  const auto factor = static_cast<float>(std::abs(header.scale));
  for (std::size_t y = height; y-- > 0;) {
    const std::uint8_t* row = pixels.data() + y * width * header.channels * sizeof(float);
    for (std::size_t i = 0; i < width * 3; ++i) {
      const std::size_t at = header.channels == 3 ? i : i / 3;
      image.rgb.push_back(factor * read_float(row + at * sizeof(float), header.scale > 0));
    }
  }
  return picture;
}

}  // namespace tyndall

#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/picture_file.h"
#include "core/image/whole_file.h"

#include <algorithm>
#include <string_view>

namespace tyndall {

void write_ppm(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               PpmCurve ppm, std::optional<DitherOrigin> dither) {
  check_writable(file, image);
  const std::string header = "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  WholeFile out(file);
  out.write(std::span(reinterpret_cast<const std::uint8_t*>(header.data()), header.size()));
  if (ppm == PpmCurve::gamma2)
    out.write(gamma2_bytes(image.rgb, exposure, curve));
  else
    out.write(dither ? tone_map_dithered(image.rgb, exposure, curve, image.width, *dither)
                     : tone_map(image.rgb, exposure, curve));
  out.commit();
}

namespace {

/// The numbers in the text of a PNM file: the header, and the pixels of P2 and P3. Between them stand white space and
/// remarks, which go from # to the end of the line. Netpbm, ppm(5) and pgm(5).
struct PnmText {
  const std::filesystem::path& file;
  std::span<const std::uint8_t> bytes;
  std::size_t at = 2;  ///< behind the mark P2, P3, ...

  char next() const { return at < bytes.size() ? static_cast<char>(bytes[at]) : '\n'; }
  bool at_gap() const { return is_space(next()) || next() == '#'; }

  void skip_gap() {
    for (; at < bytes.size() && at_gap(); ++at)
      if (next() == '#') skip_remark();
  }
  /// Up to the end of the line, which belongs to the gap.
  void skip_remark() {
    while (at < bytes.size() && next() != '\n' && next() != '\r') ++at;
  }

  /// A whole number; beyond 10^17 on either side, that. what: "the width", ...
  std::int64_t take_number(const char* what) {
    skip_gap();
    if (at == bytes.size()) cannot_read(file, std::string("damaged: the file ends where ") + what + " is expected");
    const std::size_t start = at;
    constexpr std::int64_t largest = 100'000'000'000'000'000;
    const bool negative = next() == '-';
    if (negative || next() == '+') ++at;
    const std::size_t digits = at;
    std::int64_t value = 0;
    for (; at < bytes.size() && next() >= '0' && next() <= '9'; ++at)
      value = std::min(10 * value + next() - '0', largest);
    if (at == digits || !at_gap()) fail(start, what);
    return negative ? -value : value;
  }

  [[noreturn]] void fail(std::size_t start, const char* what) {
    constexpr std::size_t longest = 24;
    for (at = start; at < bytes.size() && at - start < longest && !at_gap();) ++at;
    const std::string found(bytes.begin() + static_cast<std::ptrdiff_t>(start),
                            bytes.begin() + static_cast<std::ptrdiff_t>(at));
    cannot_read(file, "damaged: found " + in_quotes(found) + ", expected " + what + ", a whole number");
  }
};

struct PnmHeader {
  char kind = '6';  ///< the digit of the mark
  std::int64_t width = 0, height = 0;
  unsigned largest = 255;
  bool is_text() const { return kind <= '3'; }
  std::size_t channels() const { return kind == '3' || kind == '6' ? 3 : 1; }
  std::size_t numbers() const { return channels() * static_cast<std::size_t>(width * height); }
  std::size_t number_size() const { return largest > 255 ? 2 : 1; }
};

/// A number of the header, which nobody means to be this far from 0.
std::int64_t take_small_number(PnmText& text, const char* what) {
  constexpr std::int64_t largest = std::int64_t{1} << 28;
  const std::int64_t number = text.take_number(what);
  if (number <= largest && number >= -largest) return number;
  cannot_read(text.file, std::string("found a number beyond 2^28 as ") + what + ", expected a smaller one");
}

/// Reads the header and believes its size only where the file is long enough for it.
PnmHeader take_header(PnmText& text) {
  const std::string_view mark(reinterpret_cast<const char*>(text.bytes.data()), 2);
  if (mark == "P1" || mark == "P4" || mark == "P7")
    cannot_read(text.file, "found a picture of the kind " + std::string(mark) +
                               ", expected P3 or P6 (colours), or P2 or P5 (greys)");
  PnmHeader header;
  header.kind = mark[1];
  header.width = take_small_number(text, "the width");
  header.height = take_small_number(text, "the height");
  check_readable(text.file, header.width, header.height);
  const std::int64_t largest = take_small_number(text, "the largest number of a colour");
  if (largest < 1 || largest > 65535)
    cannot_read(text.file,
                "found " + std::to_string(largest) + " as the largest number of a colour, expected 1 to 65535");
  header.largest = static_cast<unsigned>(largest);
  const std::size_t left = text.bytes.size() - text.at;
  const std::size_t needed = header.is_text() ? 2 * header.numbers() : 1 + header.numbers() * header.number_size();
  if (left < needed)
    cannot_read(text.file, "damaged: found " + std::to_string(left) + " bytes behind the header, expected at least " +
                               std::to_string(needed) + " for " + std::to_string(header.width) + " x " +
                               std::to_string(header.height) + " pixels");
  return header;
}

/// Collects a picture's numbers. Those outside of 0 to `largest` become the nearest of these, and are counted.
struct PnmNumbers {
  const PnmHeader& header;
  std::vector<std::uint8_t> bytes{};  ///< as Samples has them
  std::size_t taken = 0, outside = 0, first_outside = 0;
  std::int64_t first_value = 0;

  void put(std::int64_t number) {
    const std::int64_t nearest = std::clamp<std::int64_t>(number, 0, header.largest);
    if (nearest != number && outside++ == 0) first_outside = taken, first_value = number;
    ++taken;
    for (std::size_t copies = 4 - header.channels(); copies > 0; --copies) {  // a grey stands for three
      if (header.number_size() == 2) bytes.push_back(static_cast<std::uint8_t>(nearest >> 8));
      bytes.push_back(static_cast<std::uint8_t>(nearest & 255));
    }
  }
  std::string remark() const {
    const std::size_t pixel = first_outside / header.channels(), width = static_cast<std::size_t>(header.width);
    return std::to_string(outside) + " of " + std::to_string(taken) + " numbers are outside of 0 to " +
           std::to_string(header.largest) + " and are read as the nearest that is within; the first one, " +
           std::to_string(first_value) + ", is at x " + std::to_string(pixel % width) + ", y " +
           std::to_string(pixel / width);
  }
};

void take_text(PnmText& text, PnmNumbers& numbers) {
  for (std::size_t i = numbers.header.numbers(); i > 0; --i) numbers.put(text.take_number("a colour"));
  text.skip_gap();
  check_end(text.file, text.bytes.subspan(text.at), "P");
}

void take_binary(PnmText& text, PnmNumbers& numbers) {
  const std::size_t size = numbers.header.number_size(), pixels = size * numbers.header.numbers();
  if (text.next() == '#') text.skip_remark();
  std::size_t at = pixels_after(text.bytes, text.at, pixels);
  if (text.bytes.size() - at < pixels) cannot_read(text.file, "damaged: the PPM ends in the middle");
  const std::size_t end = at + pixels;
  for (; at < end; at += size) numbers.put(size == 1 ? text.bytes[at] : text.bytes[at] * 256 + text.bytes[at + 1]);
  check_end(text.file, text.bytes.subspan(end), std::string("P") + numbers.header.kind);
}

}  // namespace

PictureFile read_ppm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, PpmCurve curve) {
  PnmText text{file, bytes};
  const PnmHeader header = take_header(text);
  PnmNumbers numbers{header};
  numbers.bytes.reserve(3 * header.number_size() * static_cast<std::size_t>(header.width * header.height));
  header.is_text() ? take_text(text, numbers) : take_binary(text, numbers);
  const Samples samples{static_cast<int>(header.width), static_cast<int>(header.height), 3, header.largest,
                        std::move(numbers.bytes)};
  PictureFile picture = picture_of(samples, curve == PpmCurve::gamma2 ? 2 : srgb_curve);
  if (numbers.outside > 0) add_remark(picture, file, numbers.remark());
  return picture;
}

}  // namespace tyndall

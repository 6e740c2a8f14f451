#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/pnm_reader.h"
#include "core/image/whole_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

namespace tyndall {

/// What ends a number.
constexpr auto is_gap = [](char c) { return c == '#' || is_space(c); };

PnmReader::PnmReader(std::filesystem::path name, PpmCurve curve, bool has_all)
    : name_(std::move(name)), power_(curve == PpmCurve::gamma2 ? 2 : srgb_curve), has_all_(has_all) {}

const char* PnmReader::expected() const {
  constexpr const char* of_header[] = {"P3 or P6 (colours), or P2 or P5 (greys)", "the width", "the height",
                                       "the largest number of a colour"};
  return part_ <= Part::largest ? of_header[static_cast<int>(part_)] : "a colour";
}

void PnmReader::take_digit(char c) {
  constexpr std::int64_t largest = 100'000'000'000'000'000;
  constexpr std::size_t longest_shown = 24;  // characters of what was found in a number's place
  const bool sign = digits_.text.empty() && (c == '-' || c == '+'), digit = c >= '0' && c <= '9';
  digits_.negative = digits_.negative || (sign && c == '-');
  digits_.any = digits_.any || digit;
  digits_.damaged = digits_.damaged || !(sign || digit);
  if (digit) digits_.value = std::min(10 * digits_.value + c - '0', largest);
  if (digits_.text.size() < longest_shown)
    digits_.text += c;
  else if (digits_.damaged)
    fail_number();
}

void PnmReader::fail_number() const {
  cannot_read(name_, "damaged: found " + in_quotes(digits_.text) + ", expected " + expected() + ", a whole number");
}

void PnmReader::take_mark(char c) {
  mark_ += c;
  if (mark_.size() < 2) return;
  if (mark_ != "P2" && mark_ != "P3" && mark_ != "P5" && mark_ != "P6")
    cannot_read(name_, "found a picture of the kind " + mark_ + ", expected " + expected());
  header_.kind = c;
  part_ = Part::width;
}

void PnmReader::take_header_number(std::int64_t number) {
  constexpr std::int64_t largest = std::int64_t{1} << 28;
  if (number > largest || number < -largest)
    cannot_read(name_, std::string("found a number beyond 2^28 as ") + expected() + ", expected a smaller one");
  if (part_ == Part::width) {
    header_.width = number;
    part_ = Part::height;
  } else if (part_ == Part::height) {
    header_.height = number;
    check_readable(name_, header_.width, header_.height);
    part_ = Part::largest;
  } else {
    if (number < 1 || number > 65535)
      cannot_read(name_, "found " + std::to_string(number) + " as the largest number of a colour, expected 1 to 65535");
    header_.largest = static_cast<unsigned>(number);
    light_ = light_table(header_.largest, power_);
    part_ = header_.is_text() ? Part::pixels : Part::gap;
  }
}

/// A number outside of the range becomes the nearest within, and is counted.
void PnmReader::put(std::int64_t number, std::vector<float>& rgb) {
  const std::int64_t nearest = std::clamp<std::int64_t>(number, 0, header_.largest);
  if (nearest != number && outside_++ == 0) first_outside_ = taken_, first_value_ = number;
  const float light = light_[static_cast<std::size_t>(nearest)];
  rgb.push_back(light);
  if (header_.channels() == 1) rgb.push_back(light), rgb.push_back(light);
  if (++taken_ == header_.numbers()) part_ = Part::end;
}

void PnmReader::take_pixel_byte(std::uint8_t byte, std::vector<float>& rgb) {
  if (header_.number_size() == 2 && !high_byte_)
    high_byte_ = byte;
  else
    put(std::exchange(high_byte_, std::nullopt).value_or(0) * 256 + byte, rgb);
}

/// Takes a character of the mark, or of what is between and behind numbers. False: it does not belong to the picture.
bool PnmReader::take_character(char c) {
  if (part_ == Part::mark) {
    take_mark(c);
    return true;
  }
  if (part_ == Part::end && (!header_.is_text() || !(in_remark_ || is_gap(c)))) return false;
  in_remark_ = in_remark_ ? c != '\n' && c != '\r' : c == '#';
  if (part_ == Part::gap && !in_remark_) part_ = c == '\r' ? Part::line_feed : Part::pixels;
  return true;
}

std::size_t PnmReader::take(std::span<const std::uint8_t> bytes, std::vector<float>& rgb, bool header_only) {
  const auto character = [&](std::size_t at) { return static_cast<char>(bytes[at]); };
  std::size_t at = 0;
  while (at < bytes.size() && !(header_only && header())) {
    const bool numbers = part_ == Part::pixels ? header_.is_text() : part_ > Part::mark && part_ < Part::gap;
    if (numbers && !in_remark_ && (!is_gap(character(at)) || !digits_.text.empty())) {
      for (; at < bytes.size() && !is_gap(character(at)); ++at) take_digit(character(at));
      if (at < bytes.size()) end(rgb);
    } else if (part_ == Part::line_feed) {
      part_ = Part::pixels;
      const bool fits = !has_all_ || bytes.size() - at > header_.number_size() * header_.numbers();
      if (bytes[at] == '\n' && fits) ++at;
    } else if (part_ == Part::pixels && !header_.is_text()) {
      for (; at < bytes.size() && part_ == Part::pixels; ++at) take_pixel_byte(bytes[at], rgb);
    } else if (take_character(character(at))) {
      ++at;
    } else {
      break;
    }
  }
  return at;
}

void PnmReader::end(std::vector<float>& rgb) {
  if (digits_.text.empty()) return;
  if (digits_.damaged || !digits_.any) fail_number();
  const Digits done = std::exchange(digits_, {});
  const std::int64_t number = done.negative ? -done.value : done.value;
  part_ <= Part::largest ? take_header_number(number) : put(number, rgb);
}

std::optional<std::string> PnmReader::remark() const {
  if (outside_ == 0) return {};
  const std::size_t pixel = first_outside_ / header_.channels(), width = static_cast<std::size_t>(header_.width);
  return std::to_string(outside_) + " of " + std::to_string(taken_) + " numbers are outside of 0 to " +
         std::to_string(header_.largest) + " and are read as the nearest that is within; the first one, " +
         std::to_string(first_value_) + ", is at x " + std::to_string(pixel % width) + ", y " +
         std::to_string(pixel / width);
}

namespace {

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
  PnmReader reader(file, curve, true);
  PictureFile picture;
  std::vector<float>& rgb = picture.image.rgb;
  std::size_t at = reader.take(bytes, rgb, true);
  if (!reader.header()) reader.end(rgb);
  const std::string ends = std::string("damaged: the file ends where ") + reader.expected() + " is expected";
  if (!reader.header()) cannot_read(file, ends);
  const PnmHeader& header = *reader.header();
  // The size that a header says is believed only where the file is long enough for it.
  const std::size_t left = bytes.size() - at;
  const std::size_t needed = header.is_text() ? 2 * header.numbers() : 1 + header.numbers() * header.number_size();
  if (left < needed)
    cannot_read(file, "damaged: found " + std::to_string(left) + " bytes behind the header, expected at least " +
                          std::to_string(needed) + " for " + std::to_string(header.width) + " x " +
                          std::to_string(header.height) + " pixels");
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
  const auto begin = bytes.first(std::min<std::size_t>(bytes.size(), 256));
  char kind = 0, word[256] = "";
  int columns = 0, rows = 0, end = 0;
  double scale = 0;  // negative: little endian
  const int read = std::sscanf(std::string(begin.begin(), begin.end()).c_str(), "P%c %9d %9d %255s%n", &kind, &columns,
                               &rows, word, &end);
  if (read != 4 || !number_from_text(word, scale) || scale == 0 || !std::isfinite(scale))
    cannot_read(file, "damaged: expected a PFM header: PF, width, height, scale");
  check_readable(file, columns, rows);
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  const std::size_t channels = kind == 'F' ? 3 : 1, row_size = channels * sizeof(float) * width;
  const auto pixels = bytes.subspan(pixels_after(bytes, static_cast<std::size_t>(end), row_size * height));
  if (pixels.size() < row_size * height) cannot_read(file, "damaged: the PFM ends in the middle");
  check_end(file, pixels.subspan(row_size * height), "P");
  PictureFile picture;
  picture.image = {columns, rows, {}};
  picture.image.rgb.reserve(width * height * 3);
  const auto factor = static_cast<float>(std::abs(scale));
  for (std::size_t y = height; y-- > 0;)
    for (std::size_t i = 0; i < width * 3; ++i) {
      const std::size_t at = y * row_size + (channels == 3 ? i : i / 3) * sizeof(float);
      picture.image.rgb.push_back(factor * read_float(&pixels[at], scale > 0));
    }
  return picture;
}

}  // namespace tyndall

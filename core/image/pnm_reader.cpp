#include "core/image/pnm_reader.h"

#include "core/base/text.h"
#include "core/image/image_io_file.h"

#include <algorithm>
#include <utility>

namespace tyndall {
PnmReader::PnmReader(std::filesystem::path name, PpmCurve curve, std::optional<std::size_t> size)
    : name_(std::move(name)), power_(curve == PpmCurve::gamma2 ? 2 : srgb_curve), size_(size) {}

const char* PnmReader::expected() const {
  constexpr const char* of_header[] = {"P3 or P6 (colours), or P2 or P5 (greys)", "the width", "the height",
                                       "the largest number of a colour"};
  return part_ <= Part::largest ? of_header[static_cast<int>(part_)] : "a colour";
}

/// Goes on behind white space and remarks. Whether that uses up the bytes.
bool PnmReader::skip_gap(std::span<const std::uint8_t> bytes, std::size_t& at) {
  for (; at < bytes.size(); ++at) {
    const char c = static_cast<char>(bytes[at]);
    if (in_remark_)
      in_remark_ = c != '\n' && c != '\r';
    else if (c == '#')
      in_remark_ = true;
    else if (!is_space(c))
      return false;
  }
  return true;
}

/// The next whole number, once the character behind it has come, where `at` then stands; beyond 10^17 on either side,
/// that. Nothing: the bytes are used up.
std::optional<std::int64_t> PnmReader::take_number(std::span<const std::uint8_t> bytes, std::size_t& at) {
  constexpr std::int64_t largest = 100'000'000'000'000'000;
  constexpr std::size_t longest_shown = 24;  // characters of what was found in a number's place
  if (digits_.text.empty() && skip_gap(bytes, at)) return {};
  for (; at < bytes.size(); ++at) {
    const char c = static_cast<char>(bytes[at]);
    if (is_space(c) || c == '#') return finish_number();
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
  return {};
}

std::int64_t PnmReader::finish_number() {
  if (digits_.damaged || !digits_.any) fail_number();
  const Digits done = std::exchange(digits_, {});
  return done.negative ? -done.value : done.value;
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
    return;
  }
  if (part_ == Part::height) {
    header_.height = number;
    check_readable(name_, header_.width, header_.height);
    part_ = Part::largest;
    return;
  }
  if (number < 1 || number > 65535)
    cannot_read(name_, "found " + std::to_string(number) + " as the largest number of a colour, expected 1 to 65535");
  header_.largest = static_cast<unsigned>(number);
  light_ = light_table(header_.largest, power_);
  part_ = header_.is_text() ? Part::pixels : Part::gap;
}

/// Takes the one character between a header and the bytes of pixels; a remark may stand before it.
void PnmReader::take_gap(char c) {
  if (in_remark_)
    in_remark_ = c != '\n' && c != '\r';
  else
    in_remark_ = c == '#';
  if (!in_remark_) part_ = c == '\r' ? Part::line_feed : Part::pixels;
}

/// Whether this character behind a CR belongs to the header. left: bytes from it on, if the size is known.
bool PnmReader::is_line_end(char c, std::size_t left) const {
  return c == '\n' && (!size_ || left > header_.number_size() * header_.numbers());
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

void PnmReader::take_pixel_bytes(std::span<const std::uint8_t> bytes, std::size_t& at, std::vector<float>& rgb) {
  for (; at < bytes.size() && part_ == Part::pixels; ++at) {
    if (header_.number_size() == 1)
      put(bytes[at], rgb);
    else if (high_byte_)
      put(*std::exchange(high_byte_, std::nullopt) * 256 + bytes[at], rgb);
    else
      high_byte_ = bytes[at];
  }
}

std::size_t PnmReader::take(std::span<const std::uint8_t> bytes, std::vector<float>& rgb, bool header_only) {
  std::size_t at = 0;
  while (at < bytes.size() && !(header_only && header())) {
    if (part_ == Part::mark) {
      take_mark(static_cast<char>(bytes[at++]));
    } else if (part_ <= Part::largest) {
      if (const auto number = take_number(bytes, at)) take_header_number(*number);
    } else if (part_ == Part::gap) {
      take_gap(static_cast<char>(bytes[at++]));
    } else if (part_ == Part::line_feed) {
      const std::size_t taken = before_ + at;
      if (is_line_end(static_cast<char>(bytes[at]), size_ ? *size_ - taken : 0)) ++at;
      part_ = Part::pixels;
    } else if (part_ == Part::end) {
      if (!header_.is_text()) break;
      if (!skip_gap(bytes, at)) break;
    } else if (header_.is_text()) {
      if (const auto number = take_number(bytes, at)) put(*number, rgb);
    } else {
      take_pixel_bytes(bytes, at, rgb);
    }
  }
  before_ += at;
  return at;
}

void PnmReader::end(std::vector<float>& rgb) {
  if (digits_.text.empty()) return;
  const std::int64_t number = finish_number();
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

}  // namespace tyndall

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

/// Takes a byte that ends no number. False: it does not belong to the picture.
bool PnmReader::take_byte(std::uint8_t byte, std::vector<float>& rgb) {
  const char c = static_cast<char>(byte);
  if (part_ == Part::line_feed) {
    part_ = Part::pixels;
    if (c == '\n' && (!size_ || *size_ - position_ > header_.number_size() * header_.numbers())) return true;
  }
  if (part_ == Part::mark) {
    take_mark(c);
  } else if (part_ > Part::gap && !header_.is_text()) {
    if (part_ == Part::end) return false;
    if (header_.number_size() == 2 && !high_byte_)
      high_byte_ = byte;
    else
      put(std::exchange(high_byte_, std::nullopt).value_or(0) * 256 + byte, rgb);
  } else if (in_remark_ || c == '#' || is_space(c)) {
    in_remark_ = in_remark_ ? c != '\n' && c != '\r' : c == '#';
    if (part_ == Part::gap && !in_remark_) part_ = c == '\r' ? Part::line_feed : Part::pixels;
  } else if (part_ == Part::end) {
    return false;
  } else {
    take_digit(c);
  }
  return true;
}

std::size_t PnmReader::take(std::span<const std::uint8_t> bytes, std::vector<float>& rgb, bool header_only) {
  std::size_t at = 0;
  while (at < bytes.size() && !(header_only && header())) {
    const char c = static_cast<char>(bytes[at]);
    if (!digits_.text.empty() && (is_space(c) || c == '#'))
      end(rgb);
    else if (take_byte(bytes[at], rgb))
      ++at, ++position_;
    else
      break;
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

}  // namespace tyndall

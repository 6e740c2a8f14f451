#include "app/text/values.h"

#include "core/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>

namespace tyndall {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw UsageError("found " + in_quotes(printable(text)) + ", expected " + expected);
}

template <std::integral T>
bool read_all(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_all(std::string_view text, double& value) { return number_from_text(text, value); }

/// Reads as many numbers as are wanted, with the separator between them.
bool read_numbers(std::string_view text, char, auto& last) { return read_all(text, last); }
bool read_numbers(std::string_view text, char separator, auto& first, auto&... rest) {
  const std::size_t end = text.find(separator);
  return end != text.npos && read_all(text.substr(0, end), first) &&
         read_numbers(text.substr(end + 1), separator, rest...);
}

}  // namespace

std::int64_t read_whole(const std::string& text, std::int64_t low, std::int64_t high) {
  return read_whole(text, between(static_cast<double>(low), static_cast<double>(high)),
                    "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
}

std::int64_t read_whole(const std::string& text, Valid valid, const std::string& expected) {
  std::int64_t value = 0;
  if (!read_all(text, value) || !valid.contains(static_cast<double>(value))) refuse(text, expected);
  return value;
}

double read_number(const std::string& text, Valid valid, const std::string& expected) {
  double value = 0;
  if (!read_all(text, value) || !std::isfinite(value) || !valid.contains(value)) refuse(text, expected);
  return value;
}

Size read_size(const std::string& text) {
  Size size;
  if (!read_numbers(text, 'x', size.width, size.height) || size.width < 1 || size.height < 1)
    refuse(text, "WIDTHxHEIGHT in pixels, such as 800x450");
  return size;
}

SampleRange read_samples(const std::string& text) {
  SampleRange range;
  if (!read_numbers(text, ':', range.first, range.last) || range.first >= range.last)
    refuse(text, "A:B with whole numbers 0 <= A < B, such as 0:64");
  if (range.last - range.first > max_samples) refuse(text, "at most " + std::to_string(max_samples) + " samples");
  return range;
}

FrameRange read_frames(const std::string& text) {
  FrameRange range;
  if (!read_numbers(text, ':', range.first, range.last) || range.first < 0 || range.first >= range.last)
    refuse(text, "A:B with whole numbers 0 <= A < B, such as 0:48");
  return range;
}

Region read_region(const std::string& text) {
  Region r;
  if (!read_numbers(text, ',', r.x0, r.y0, r.x1, r.y1) || r.x0 < 0 || r.y0 < 0 || r.x0 >= r.x1 || r.y0 >= r.y1)
    refuse(text, "X0,Y0,X1,Y1 in pixels with 0 <= X0 < X1 and 0 <= Y0 < Y1");
  return r;
}

SampleKey read_sample_key(const std::string& text) {
  SampleKey key;
  if (!read_numbers(text, ',', key.x, key.y, key.sample) || key.x < 0 || key.y < 0)
    refuse(text, "X,Y,SAMPLE with whole numbers >= 0, such as 12,40,7");
  return key;
}

Override read_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || text.front() != '/')
    refuse(text, "POINTER=VALUE, such as /materials/gold/fuzz=0.2");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::filesystem::path read_file_name(const std::string& text, const std::string& ending) {
  if (lower_case(std::filesystem::path(text).extension().string()) != ending)
    refuse(text, "a name that ends in " + ending);
  return text;
}

std::size_t read_name(const std::string& text, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) refuse(text, one_of({names.begin(), names.end()}) + suggestion(text, names));
  return static_cast<std::size_t>(found - names.begin());
}

std::string wrapped(const std::string& text, std::size_t columns) {
  std::string out;
  std::size_t used = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t inside = text[at] == '[' ? text.find(']', at) : at;
    const std::size_t end = std::min(text.find(' ', std::min(inside, text.size())), text.size());
    const bool fits = out.empty() || used + 1 + (end - at) <= columns;
    if (!out.empty()) out += fits ? ' ' : '\n';
    used = (fits && !out.empty() ? used + 1 : 0) + (end - at);
    out += text.substr(at, end - at);
    at = end + 1;
  }
  return out;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  return did_you_mean(word, {names.begin(), names.end()});
}

}  // namespace tyndall

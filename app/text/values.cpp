#include "app/text/values.h"

#include "core/base/text.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <utility>

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

/// JSON in one line.
std::string one_line(const JsonValue& json) {
  if (const auto* text = std::get_if<std::string>(&json.value)) return in_quotes(*text);
  std::vector<std::string> parts;
  if (const auto* array = std::get_if<JsonArray>(&json.value)) {
    for (const JsonValue& item : *array) parts.push_back(one_line(item));
    return "[" + joined(parts) + "]";
  }
  if (const auto* object = std::get_if<JsonObject>(&json.value)) {
    for (const JsonMember& member : *object) parts.push_back(in_quotes(member.key) + ": " + one_line(member.value));
    return "{" + joined(parts) + "}";
  }
  return describe(json);
}

/// The values of a JSON list; nothing if the text is none.
std::optional<std::vector<std::string>> list_values(const std::string& text) {
  if (!text.starts_with('[')) return {};
  try {
    const JsonDocument json = parse_json(text);
    std::vector<std::string> values;
    for (const JsonValue& item : std::get<JsonArray>(json.root.value)) {
      const auto* itself = std::get_if<std::string>(&item.value);
      values.push_back(itself ? *itself : one_line(item));
    }
    return values;
  } catch (const ParseError&) {
    return {};
  }
}

/// FROM:TO:STEPS: so many numbers from one to another, both included; rounded to 12 digits, so that they are those that
/// users would type.
std::optional<std::vector<std::string>> number_values(const std::string& text) {
  const std::vector<std::string> parts = split_at(text, ':');
  double from = 0, to = 0;
  if (parts.size() != 3 || !number_from_text(parts[0], from) || !number_from_text(parts[1], to)) return {};
  if (!std::isfinite(from) || !std::isfinite(to)) return {};
  const auto steps = static_cast<int>(read_whole(parts[2], 2, max_sweep_steps));
  std::vector<std::string> values;
  for (int i = 0; i < steps; ++i) {
    const double part = static_cast<double>(i) / (steps - 1);
    const double exact = i + 1 == steps ? to : from + part * (to - from);
    // What is left of two numbers that cancel is 0: -0.3:0.3:7 goes through 0, not through 5.6e-17.
    const bool cancels = std::abs(exact) < 1e-12 * std::abs(to - from);
    values.push_back(number_text(cancels ? 0 : std::strtod(fmt::format("{:.12g}", exact).c_str(), nullptr)));
  }
  return values;
}

/// A:B with A < B.
template <class T>
Range<T> read_range(const std::string& text, const std::string& example) {
  Range<T> range;
  if (!read_numbers(text, ':', range.first, range.last) || std::cmp_less(range.first, 0) || range.first >= range.last)
    refuse(text, "A:B with whole numbers 0 <= A < B, such as " + example);
  return range;
}

/// The pattern in a name whose place ends with that letter.
NamePattern read_pattern(const std::string& text, char letter, const std::string& expected) {
  NamePattern pattern;
  std::string* part = &pattern.before;
  for (std::string_view rest = text; !rest.empty();) {
    if (rest[0] != '%' || rest.starts_with("%%")) {
      *part += rest[0];
      rest.remove_prefix(rest[0] == '%' ? 2 : 1);
      continue;
    }
    const bool padded = letter == 'd' && rest.size() > 3 && rest[1] == '0' && rest[2] >= '0' && rest[2] <= '9';
    if (padded) pattern.digits = rest[2] - '0';
    rest.remove_prefix(padded ? 3 : 1);
    if (part == &pattern.after || !rest.starts_with(letter)) refuse(text, expected);
    rest.remove_prefix(1);
    part = &pattern.after;
  }
  if (part == &pattern.before) refuse(text, expected);
  return pattern;
}

}  // namespace

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text + separator);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

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
  const auto range = read_range<std::uint32_t>(text, "0:64");
  if (range.last - range.first > max_samples) refuse(text, "at most " + std::to_string(max_samples) + " samples");
  return range;
}

FrameRange read_frames(const std::string& text) { return read_range<int>(text, "0:48"); }

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

std::filesystem::path read_file_name(const std::string& text, const std::vector<std::string>& endings) {
  if (std::ranges::count(endings, lower_case(std::filesystem::path(text).extension().string())) == 0)
    refuse(text, "a name that ends in " + joined(endings, " or "));
  return text;
}

std::size_t read_name(const std::string& text, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end())
    refuse(text, one_of({names.begin(), names.end()}) + did_you_mean(text, {names.begin(), names.end()}));
  return static_cast<std::size_t>(found - names.begin());
}

SweepAxis read_sweep_axis(const std::string& text) {
  constexpr const char* expected =
      "POINTER=FROM:TO:STEPS, such as /materials/gold/fuzz=0:0.4:5, a list such as [0,0.1,0.5], or names such as "
      "gold,glass";
  const std::size_t equals = text.find('=');
  if (equals == text.npos || text.front() != '/') refuse(text, expected);
  SweepAxis axis{text.substr(0, equals), {}};
  std::string values = text.substr(equals + 1);
  auto read = list_values(values);
  if (!read) read = number_values(values);
  if (!read && values.size() > 1 && values.front() == '[' && values.back() == ']')
    values = values.substr(1, values.size() - 2);
  axis.values = read ? std::move(*read) : split_at(values, ',');
  if (axis.values.size() < 2) refuse(text, expected);
  for (auto here = axis.values.begin(); here != axis.values.end(); ++here) {
    if (here->empty()) refuse(text, expected);
    if (std::find(axis.values.begin(), here, *here) != here)
      refuse(text, "each value once; " + *here + " is there twice");
  }
  return axis;
}

NamePattern read_numbered_name(const std::string& text) {
  return read_pattern(text, 'd', "a name with the frame's number in it once, as %04d: 'f/%04d.png'");
}

NamePattern read_valued_name(const std::string& text) {
  return read_pattern(text, 'v', "a name with the value in it once, as %v: 'dir/%v.exr'");
}

std::string name_for(const NamePattern& pattern, int number) {
  return fmt::format("{}{:0{}}{}", pattern.before, number, pattern.digits, pattern.after);
}

std::string name_for(const NamePattern& pattern, std::string value) {
  std::replace(value.begin(), value.end(), '/', '_');
  return pattern.before + value + pattern.after;
}

}  // namespace tyndall

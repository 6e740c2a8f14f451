#include "app/files/sweep_values.h"

#include "app/text/values.h"
#include "core/base/text.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace tyndall {
namespace {

[[noreturn]] void refuse_values(const std::string& text, const std::string& expected) {
  throw UsageError("found " + in_quotes(printable(text)) + ", expected " + expected);
}

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
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

/// The same, but a text as itself.
std::string value_text(const JsonValue& json) {
  const auto* text = std::get_if<std::string>(&json.value);
  return text ? *text : one_line(json);
}

/// The values of a JSON list; nothing if the text is none.
std::optional<std::vector<std::string>> list_values(const std::string& text) {
  if (!text.starts_with('[')) return {};
  try {
    const JsonDocument json = parse_json(text);
    std::vector<std::string> values;
    for (const JsonValue& item : std::get<JsonArray>(json.root.value)) values.push_back(value_text(item));
    return values;
  } catch (const ParseError&) {
    return {};
  }
}

/// So many numbers from one to another, both included; rounded to 12 digits, so that they are those that users would
/// type.
std::vector<double> even_steps(double from, double to, int steps) {
  std::vector<double> values;
  for (int i = 0; i < steps; ++i) {
    const double part = static_cast<double>(i) / (steps - 1);
    const double exact = i + 1 == steps ? to : from + part * (to - from);
    // What is left of two numbers that cancel is 0: -0.3:0.3:7 goes through 0, not through 5.6e-17.
    const bool cancels = std::abs(exact) < 1e-12 * std::abs(to - from);
    values.push_back(cancels ? 0 : std::strtod(fmt::format("{:.12g}", exact).c_str(), nullptr));
  }
  return values;
}

std::optional<std::vector<std::string>> number_values(const std::string& text) {
  const std::vector<std::string> parts = split_at(text, ':');
  double from = 0, to = 0;
  if (parts.size() != 3 || !number_from_text(parts[0], from) || !number_from_text(parts[1], to)) return {};
  if (!std::isfinite(from) || !std::isfinite(to)) return {};
  const auto steps = static_cast<int>(read_whole(parts[2], 2, max_sweep_steps));
  std::vector<std::string> values;
  for (const double value : even_steps(from, to, steps)) values.push_back(number_text(value));
  return values;
}

}  // namespace

SweepAxis read_sweep_axis(const std::string& text) {
  constexpr const char* expected =
      "POINTER=FROM:TO:STEPS, such as /materials/gold/fuzz=0:0.4:5, a list such as [0,0.1,0.5], or names such as "
      "gold,glass";
  const std::size_t equals = text.find('=');
  if (equals == text.npos || text.front() != '/') refuse_values(text, expected);
  SweepAxis axis{text.substr(0, equals), {}};
  std::string values = text.substr(equals + 1);
  if (auto list = list_values(values)) {
    axis.values = std::move(*list);
  } else if (auto numbers = number_values(values)) {
    axis.values = std::move(*numbers);
  } else {
    if (values.size() > 1 && values.front() == '[' && values.back() == ']')
      values = values.substr(1, values.size() - 2);
    axis.values = split_at(values, ',');
  }
  if (axis.values.size() < 2) refuse_values(text, expected);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    if (axis.values[i].empty()) refuse_values(text, expected);
    for (std::size_t k = 0; k < i; ++k)
      if (axis.values[k] == axis.values[i])
        refuse_values(text, "each value once; " + axis.values[i] + " is there twice");
  }
  return axis;
}

}  // namespace tyndall

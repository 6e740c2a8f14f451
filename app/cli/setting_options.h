#pragma once
#include "app/cli/requests.h"
#include "core/base/text.h"
#include "core/scene/place.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// Options for the values that a struct lists in fields(): their names, ranges and help all follow from it.
namespace tyndall {

/// Columns that the help of an option has beside its name, where its lines are not broken by hand.
inline constexpr std::size_t help_width = 66;

/// A value from the text of an option. Throw UsageError.
template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) void read_option(const std::string& text, Meaning meaning,
                                                                             T& out) {
  Valid& valid = meaning.valid;
  valid.low = std::max(valid.low, static_cast<double>(std::numeric_limits<T>::min()));
  valid.high = std::min(valid.high, static_cast<double>(std::numeric_limits<T>::max()));
  out = static_cast<T>(read_whole(text, valid, expected_text(meaning, Form::whole)));
}
inline void read_option(const std::string& text, const Meaning& meaning, double& out) {
  out = read_number(text, meaning.valid, expected_text(meaning, Form::number));
}
inline void read_option(const std::string& text, const Meaning&, bool& out) {
  out = read_name(text, {"off", "on"}) == 1;
}
template <NamedEnum E>
void read_option(const std::string& text, const Meaning&, E& out) {
  const std::vector<std::string_view> names = names_of<E>();
  out = static_cast<E>(read_name(text, {names.begin(), names.end()}));
}

/// What the help of an option says of its value: what it is called, what can be chosen, and the same with helps, such
/// as ": random (independent numbers); sobol (...)".
struct ValueWords {
  std::string unit = "N";
  std::vector<std::string> choices{};
  std::string choices_text{};
};
template <class T>
ValueWords words_of(const Meaning& meaning = {}) {
  if constexpr (std::is_same_v<T, bool>) return {"on|off", {"on", "off"}};
  if constexpr (std::is_same_v<T, double>) return {*meaning.unit ? meaning.unit : "X"};
  ValueWords words;
  if constexpr (NamedEnum<T>) {
    words.unit = "NAME";
    for (int i = 0; i < count_of<T>(); ++i) {
      const Label choice = label(static_cast<T>(i));
      words.choices.emplace_back(choice.name);
      words.choices_text += std::string(i == 0 ? ": " : "; ") + choice.name;
      if (*choice.help) words.choices_text += std::string(" (") + choice.help + ")";
    }
  }
  return words;
}

/// Rows for all fields of a part of SceneRequest but those that may be absent. A switch that is off by default needs no
/// value.
template <class Settings>
std::vector<OptionRow> setting_rows(Changes<Settings> SceneRequest::*changes) {
  std::vector<OptionRow> rows;
  const auto add = [&]<class T>(const Field<Settings, T>& field) {
    const T usual = Settings().*field.value;
    const auto take = [=](CommandRequest& request, const std::string& text) {
      T value{};
      read_option(text, meaning_of(field), value);
      set(request.scene.*changes, field.value, value);
    };
    const ValueWords words = words_of<T>(meaning_of(field));
    std::string name = std::string("--") + field.name;
    std::replace(name.begin(), name.end(), '_', '-');
    rows.emplace_back(
        name, words.unit, Taker{take, Takes::once, words.choices},
        wrapped(field.help + words.choices_text + " [from the scene, else " + setting_text(usual) + "]", help_width));
    if constexpr (std::is_same_v<T, bool>)
      if (!usual) rows.back().unit = "", rows.back().taker = {take, Takes::flag};
  };
  for_each_field(fields_of<Settings>(), [&]<class T>(const Field<Settings, T>& field) {
    if constexpr (requires { read_option("", {}, std::declval<T&>()); }) add(field);
  });
  return rows;
}

}  // namespace tyndall

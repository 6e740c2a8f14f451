#pragma once
#include "app/cli/requests.h"
#include "app/manual/page.h"
#include "core/base/text.h"
#include "core/scene/place.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// The options of all commands, and the commands, a row each; and how the words after a command are read by them.
namespace tyndall {

/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);

const std::vector<CommandRow>& command_rows();
/// A method of a chart: a command of which nothing but the options counts.
const CommandRow& method_row();

/// " (see tyndall render --help)".
std::string see_help(std::string_view command);

/// Reads the words after a command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<std::string> parse(const CommandRow& command, std::vector<std::string> arguments,
                                 CommandRequest& request);

/// The curve of a chart that --method describes, NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text);

/// Columns that the help of an option has beside its name, where its lines are not broken by hand.
inline constexpr std::size_t help_width = 66;

/// A value from the text of an option. Throws UsageError.
template <class T>
T read_option(const std::string& text, Meaning meaning = {}) {
  if constexpr (NamedEnum<T>) {
    const std::vector<std::string_view> names = names_of<T>();
    return static_cast<T>(read_name(text, {names.begin(), names.end()}));
  } else if constexpr (std::is_same_v<T, bool>) {
    return read_name(text, {"off", "on"}) == 1;
  } else if constexpr (std::is_same_v<T, double>) {
    return read_number(text, meaning.valid, expected_text(meaning, Form::number));
  } else {
    Valid& valid = meaning.valid;
    valid.low = std::max(valid.low, static_cast<double>(std::numeric_limits<T>::min()));
    valid.high = std::min(valid.high, static_cast<double>(std::numeric_limits<T>::max()));
    return static_cast<T>(read_whole(text, valid, expected_text(meaning, Form::whole)));
  }
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
  for_each_field(fields_of<Settings>(), [&]<class T>(const Field<Settings, T>& field) {
    if constexpr (std::is_arithmetic_v<T> || NamedEnum<T>) {
      const T usual = Settings().*field.value;
      ValueWords words = words_of<T>(meaning_of(field));
      const bool is_flag = std::is_same_v<T, bool> && usual == T();
      if (is_flag) words = {"", {}, ""};
      std::string name = std::string("--") + field.name;
      std::replace(name.begin(), name.end(), '_', '-');
      const auto take = [=](CommandRequest& request, const std::string& text) {
        set(request.scene.*changes, field.value, read_option<T>(text, meaning_of(field)));
      };
      rows.emplace_back(
          name, words.unit, Taker{take, is_flag ? Takes::flag : Takes::once, words.choices},
          wrapped(field.help + words.choices_text + " [from the scene, else " + setting_text(usual) + "]", help_width));
    }
  });
  return rows;
}

}  // namespace tyndall

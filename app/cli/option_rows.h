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

/// The options of all commands, and the commands, a row each; and how a command line is read by them.
namespace tyndall {

/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);

const std::vector<CommandRow>& command_rows();

/// The commands with the options that their groups name.
std::vector<CommandRow> with_options(std::vector<CommandRow> commands);

/// " (see tyndall render --help)".
std::string see_help(std::string_view command);

/// Reads what follows a command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<std::string> parse(const CommandRow& command, std::vector<std::string> arguments,
                                 CommandRequest& request);

/// The curve of a chart that --method describes, NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text);

/// A value from the text of an option. Throws UsageError.
template <class T>
T read_option(const std::string& text, Meaning meaning) {
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

/// The row with what its value is called, and what can be chosen, for a value of type T. usual: what it is where the
/// option is not given.
template <class T>
OptionRow described(OptionRow row, const Meaning& meaning, const std::string& usual) {
  row.unit = "N";
  if constexpr (std::is_same_v<T, bool>) row.unit = "on|off", row.taker.choices = {"on", "off"};
  if constexpr (std::is_same_v<T, double>) row.unit = *meaning.unit ? meaning.unit : "X";
  if constexpr (NamedEnum<T>) {
    row.unit = "NAME";
    for (int i = 0; i < count_of<T>(); ++i) {
      const Label choice = label(static_cast<T>(i));
      row.taker.choices.emplace_back(choice.name);
      row.help += std::string(i == 0 ? ": " : "; ") + choice.name;
      if (*choice.help) row.help += std::string(" (") + choice.help + ")";
    }
  }
  row.help += " [" + usual + "]";
  return row;
}

/// Rows for all fields of a part of SceneRequest but those that may be absent. A switch that is off by default needs no
/// value.
template <class Settings>
std::vector<OptionRow> setting_rows(Changes<Settings> SceneRequest::*changes) {
  std::vector<OptionRow> rows;
  for_each_field(fields_of<Settings>(), [&]<class T>(const Field<Settings, T>& field) {
    if constexpr (std::is_arithmetic_v<T> || NamedEnum<T>) {
      const T usual = Settings().*field.value;
      const auto take = [=](CommandRequest& request, const std::string& text) {
        set(request.scene.*changes, field.value, read_option<T>(text, meaning_of(field)));
      };
      std::string name = std::string("--") + field.name;
      std::replace(name.begin(), name.end(), '_', '-');
      rows.push_back(described<T>({name, "", Taker{take}, field.help}, meaning_of(field),
                                  "from the scene, else " + setting_text(usual)));
      if (std::is_same_v<T, bool> && usual == T()) rows.back().unit = "", rows.back().taker = {take, Takes::flag};
    }
  });
  return rows;
}

}  // namespace tyndall

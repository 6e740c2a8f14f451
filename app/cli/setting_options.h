#pragma once
#include "app/cli/requests.h"
#include "app/files/open_scene.h"
#include "core/base/text.h"
#include "core/scene/place.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// What Tyndall's commands add to CLI11: values that are read by functions which say what they expected, so that every
/// refusal reads alike ("--size: found "8", expected WIDTHxHEIGHT ..."), a usage line of our own, and options for the
/// values that a struct lists in fields(): their names, values, ranges and help all follow from it.
namespace tyndall {

/// Takes the text of a value; throws UsageError `found "X", expected Y`.
using Reader = std::function<void(const std::string&)>;

/// Columns that the help of an option has beside its name.
inline constexpr std::size_t help_width = 66;

/// A command. usage: its name, then what follows it, as the help shows it; about, examples: text before and after the
/// options. Of an option that is given several times the last counts, unless it says otherwise.
std::unique_ptr<CLI::App> new_command(const std::string& usage, const std::string& about,
                                      const std::string& examples = "");

/// How often an option may be given: a flag takes no value, of `once` the last value counts.
enum class Takes { flag, once, each };

/// An option, or without dashes in its names an argument. names: "-t,--threads"; unit: what the help calls the value;
/// choices: the values that it takes, where they have names, for shells that complete them.
void add_option(CLI::App& app, const std::string& names, const std::string& unit, const std::string& help, Reader read,
                Takes takes = Takes::once, const std::vector<std::string>& choices = {});

/// Reads the words after the command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<PrintCommand> parse(CLI::App& app, std::vector<std::string> arguments);

/// "tone_map" -> "--tone-map".
inline std::string option_name(std::string_view field) {
  std::string name = "--" + std::string(field);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

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
template <class T>
void read_option(const std::string& text, const Meaning& meaning, std::optional<T>& out) {
  read_option(text, meaning, out.emplace());
}

/// What the help calls the value of an option.
template <class T>
std::string placeholder(const Meaning& meaning, const T&) {
  if constexpr (NamedEnum<T>) return "NAME";
  if constexpr (std::is_same_v<T, bool>) return "on|off";
  if constexpr (std::is_same_v<T, double>) return *meaning.unit ? meaning.unit : "X";
  return "N";
}

/// The choices with their helps, such as ": random (independent numbers); sobol (...)"; "" where there are none.
template <class T>
std::string choices_text(const T&) {
  std::string text;
  if constexpr (NamedEnum<T>)
    for (int i = 0; i < count_of<T>(); ++i) {
      const Label choice = label(static_cast<T>(i));
      text += std::string(text.empty() ? ": " : "; ") + choice.name +
              (*choice.help ? std::string(" (") + choice.help + ")" : "");
    }
  return text;
}

/// The names of the choices, if there are any.
template <class T>
std::vector<std::string> choices(const T&) {
  if constexpr (NamedEnum<T>) {
    const auto names = names_of<T>();
    return {names.begin(), names.end()};
  } else {
    return {};
  }
}

/// One option. A switch that is off by default needs no value.
template <class Owner, class T>
void add_setting(CLI::App& app, Changes<Owner>& changes, const Field<Owner, T>& field) {
  const T usual = Owner().*field.value;
  const std::string help =
      wrapped(field.help + choices_text(usual) + " [from the scene, else " + setting_text(usual) + "]", help_width);
  if constexpr (std::is_same_v<T, bool>)
    if (!usual) {
      add_option(
          app, option_name(field.name), "", help,
          [&changes, field](const std::string&) { set(changes, field.value, true); }, Takes::flag);
      return;
    }
  add_option(
      app, option_name(field.name), placeholder(meaning_of(field), usual), help,
      [&changes, field](const std::string& text) {
        T value{};
        read_option(text, meaning_of(field), value);
        set(changes, field.value, value);
      },
      Takes::once, choices(usual));
}

/// Options for all fields of a struct but some.
template <class Owner>
void add_settings(CLI::App& app, Changes<Owner>& changes, std::initializer_list<std::string_view> without = {}) {
  for_each_field(fields_of<Owner>(), [&](const auto& field) {
    if (std::find(without.begin(), without.end(), field.name) == without.end()) add_setting(app, changes, field);
  });
}

}  // namespace tyndall

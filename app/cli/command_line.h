#pragma once
#include "app/text/values.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// Columns that the help of an option has beside its name.
inline constexpr std::size_t help_width = 66;

/// The options and arguments of one command. Values arrive as text and are read by functions that throw UsageError, so
/// that every refusal reads alike: "--size: found '8', expected WIDTHxHEIGHT ...".
class CommandLine {
 public:
  using Reader = std::function<void(const std::string&)>;

  /// usage: the command, then what follows it, as the help shows it; about, examples: text before and after the
  /// options.
  CommandLine(const std::string& usage, const std::string& about, const std::string& examples);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Heading of the options that follow.
  void group(const std::string& name);
  /// names: "-t,--threads"; unit: what the help calls the value. The last of several wins.
  void value(const std::string& names, const std::string& unit, const std::string& help, Reader read);
  /// The same; may be given several times, each time with one value.
  void values(const std::string& names, const std::string& unit, const std::string& help, Reader read);
  void flag(const std::string& names, const std::string& help, bool& on);
  void flag(const std::string& names, const std::string& help, std::function<void()> switch_on);
  /// One argument without a dash; stays as it is if it is not given.
  void argument(const std::string& name, const std::string& help, std::string& text);
  void arguments(const std::string& name, const std::string& help, std::vector<std::string>& texts);

  /// Reads the words after the command. Returns the help text if that is asked for.
  std::optional<std::string> read(std::vector<std::string> words);
  /// Throws "WHAT is missing" unless it was given; for what is required.
  void require(bool given, const std::string& what) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall

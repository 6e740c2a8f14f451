#pragma once
#include "tests/bench/bench.h"

#include <optional>

/// The command line of the benchmarks.
namespace tyndall::bench {

/// Wrong usage of the command line. what(): one line.
struct UsageError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Reads the words after the program's name; nothing if help was asked for and printed. Throws UsageError.
std::optional<Settings> read_settings(std::vector<std::string> arguments);

}  // namespace tyndall::bench

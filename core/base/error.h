#pragma once
#include <stdexcept>
#include <string>

/// Errors that are told to the user in one line, and the limits of the system that they name. main() turns each kind of
/// error into its exit code.
namespace tyndall {

/// A scene that cannot be rendered: the user has to change it. what() is one line without control characters; long
/// parts are shortened.
struct SceneError : std::runtime_error {
  /// "FILE: WHERE: found FOUND, expected EXPECTED"; where: a JSON pointer, "line 3, column 5" or a flag.
  SceneError(const std::string& file, const std::string& where, const std::string& found, const std::string& expected);
  /// "FILE: found FOUND, expected EXPECTED": about the file as a whole.
  SceneError(const std::string& file, const std::string& found, const std::string& expected);

  std::string file, where, found, expected;  ///< the parts of the line; where: "" for the file as a whole
};

/// What the user asks for cannot be done, for example with the file that is named. what() is one line.
struct UsageError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Something outside of the program failed, for example a file or a device. what() is one line.
struct IoError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// The limits of memory that are set for this process, as messages add them: " (the address space is limited to 0.3 GB:
/// ulimit -v)"; "" if there are none.
std::string memory_limit_text();
/// Those that can keep a thread from starting: "; this user may have 64 threads and processes: ulimit -u".
std::string thread_limit_text();

}  // namespace tyndall

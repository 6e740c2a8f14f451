#pragma once
#include <stdexcept>
#include <string>

/// Errors that are told to the user in one line. main() turns each kind into its exit code.
namespace tyndall {

/// A scene that cannot be rendered: the user has to change it. what() is one line without control characters; long
/// parts are shortened.
struct SceneError : std::runtime_error {
  /// "FILE: WHERE: found FOUND, expected EXPECTED"; where: a JSON pointer, "line 3, column 5" or a flag.
  SceneError(const std::string& file, const std::string& where, const std::string& found, const std::string& expected);
  /// "FILE: found FOUND, expected EXPECTED": about the file as a whole.
  SceneError(const std::string& file, const std::string& found, const std::string& expected);
};

/// Something outside of the program failed, for example a file or a device. what() is one line.
struct IoError : std::runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace tyndall

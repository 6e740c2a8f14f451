#pragma once
#include <stdexcept>
#include <string>

namespace tyndall {

/// A scene that cannot be rendered: the user's fault. what() is one line without control characters; long parts are
/// cut.
struct SceneError : std::runtime_error {
  /// "FILE: WHERE: found FOUND, expected EXPECTED"; where: a JSON pointer, "line 3, column 5" or a flag.
  SceneError(const std::string& file, const std::string& where, const std::string& found, const std::string& expected);
  /// "FILE: found FOUND, expected EXPECTED": about the file as a whole.
  SceneError(const std::string& file, const std::string& found, const std::string& expected);
};

/// Something outside of the program failed: a file, a device. One line.
struct IoError : std::runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace tyndall

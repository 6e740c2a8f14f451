#pragma once
#include <stdexcept>
#include <string>

namespace tyndall {

/// A scene that cannot be rendered: the user's fault. what(): "FILE: /json/pointer: found X, expected Y", one line.
struct SceneError : std::runtime_error {
  SceneError(const std::string& file, const std::string& where, const std::string& found, const std::string& expected)
      : runtime_error(file + ": " + where + ": found " + found + ", expected " + expected) {}
};

/// Something outside of the program failed: a file, a device. One line.
struct IoError : std::runtime_error {
  using runtime_error::runtime_error;
};

}  // namespace tyndall

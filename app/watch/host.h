#pragma once
#include <cfenv>
#include <cstdint>
#include <string>

/// The program that the library is used by, and what is its own.
namespace tyndall {

/// While it lives, this thread and those that it starts compute as the IEEE standard says and as pictures need it:
/// rounding to nearest, with denormal numbers, without traps. In the end all is as it was: a program that was compiled
/// with -ffast-math has no denormal numbers, others may round otherwise. Also restores the locale's character type,
/// which the window system sets.
class Host {
 public:
  using Function = void (*)(void* user, double x, double y, std::uint64_t sample, double rgb[3]);

  /// The program's function, and its first argument.
  Host(Function called, void* argument);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// What calls the program's function with the program's own arithmetic, and its first argument. From any thread.
  Function function() const;
  void* user();

 private:
  Function called_;
  void* argument_;
  bool differs_ = false;  ///< in arithmetic
  std::fenv_t arithmetic_{};
  std::string character_type_;
};

}  // namespace tyndall

#pragma once
#include <cfenv>
#include <string>

/// The program that the library is used by, and what is its own.
namespace tyndall {

/// While it lives, this thread and those that it starts compute as the IEEE standard says and as pictures need it:
/// rounding to nearest, with denormal numbers, without traps. In the end all is as it was: a program that was compiled
/// with -ffast-math has no denormal numbers, others may round otherwise. Also restores the locale's character type,
/// which the window system sets.
class Host {
 public:
  Host();
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Calls the program's own code with its own arithmetic. From any thread.
  template <class Call>
  void call(const Call& call) const {
    if (!differs_) return call();
    struct Back {
      ~Back() { std::fesetenv(FE_DFL_ENV); }
    } back;
    std::fesetenv(&arithmetic_);
    call();
  }

 private:
  std::fenv_t arithmetic_{};
  bool differs_ = false;
  std::string character_type_;
};

}  // namespace tyndall

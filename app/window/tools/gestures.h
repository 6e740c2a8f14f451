#pragma once
#include <cstdint>

/// Which edits undo takes back together.
namespace tyndall {

/// What edits for as long as it lasts: a button or key that is down, or the turning wheel.
enum class Gesture { none, held, wheel };

/// Gives every gesture a number. All edits between the press of a button or key and its release have the same number,
/// and so have those of a wheel that turns on: they are one step to undo.
class Gestures {
 public:
  /// To be called in each drawing, before its edits are kept.
  void update(Gesture now) {
    if (now == Gesture::none || now != last_) ++number_;
    last_ = now;
  }
  /// The number of edits that are made now.
  std::uint64_t current() const { return number_; }
  /// A number for one edit that is a step of its own.
  std::uint64_t begin() {
    last_ = Gesture::none;
    return ++number_;
  }

 private:
  std::uint64_t number_ = 1;
  Gesture last_ = Gesture::none;
};

}  // namespace tyndall

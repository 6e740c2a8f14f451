#pragma once
#include <cstdint>

/// Which edits undo takes back together.
namespace tyndall {

/// Gives every gesture a number. All edits between the press of a button or key and its release have the same number,
/// and so they are one step to undo.
class Gestures {
 public:
  /// To be called in each drawing, before edits are made. held: a button or key that edits is down.
  void update(bool held) {
    if (!held || !was_held_) ++number_;
    was_held_ = held;
  }
  /// The number of edits that are made now.
  std::uint64_t current() const { return number_; }
  /// A number for one edit that is a step of its own.
  std::uint64_t begin() { return ++number_; }

 private:
  std::uint64_t number_ = 1;
  bool was_held_ = false;
};

}  // namespace tyndall

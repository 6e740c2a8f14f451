#pragma once
#include <cstdint>

namespace tyndall {

/// Numbers gestures: all edits from the press of a button or key to its release are one, and one step to undo.
class Gestures {
 public:
  /// To be called in each drawing, before edits are made. held: a button or key that edits is down.
  void update(bool held) {
    if (!held || !was_held_) ++number_;
    was_held_ = held;
  }
  /// Of edits that are made now.
  std::uint64_t current() const { return number_; }
  /// Of an edit that belongs to no other one.
  std::uint64_t begin() { return ++number_; }

 private:
  std::uint64_t number_ = 1;
  bool was_held_ = false;
};

}  // namespace tyndall

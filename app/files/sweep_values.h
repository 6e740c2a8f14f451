#pragma once
#include <string>
#include <vector>

/// The values that a sweep goes through.
namespace tyndall {

/// A value of the scene by its JSON pointer, and what it is to be in turn, each as --set takes it.
struct SweepAxis {
  std::string pointer;
  std::vector<std::string> values;
};

inline constexpr int max_sweep_steps = 10000;

/// POINTER=FROM:TO:STEPS, POINTER=[0,0.1,0.5] or POINTER=gold,glass. Throws UsageError `found "X", expected Y`.
SweepAxis read_sweep_axis(const std::string& text);

}  // namespace tyndall

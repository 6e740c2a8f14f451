#pragma once
#include <chrono>

/// Lengths of time as plain numbers.
namespace tyndall {

using Clock = std::chrono::steady_clock;

/// Seconds from `from` to `to`; negative where `to` was earlier.
inline double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Seconds from `from` until now.
inline double seconds_since(Clock::time_point from) { return seconds_between(from, Clock::now()); }

}  // namespace tyndall

#pragma once
#include <chrono>

/// Lengths of time as plain numbers.
namespace tyndall {

/// Seconds from `from` to `to`; negative where `to` was earlier.
inline double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Seconds from `from` until now.
inline double seconds_since(std::chrono::steady_clock::time_point from) {
  return seconds_between(from, std::chrono::steady_clock::now());
}

}  // namespace tyndall

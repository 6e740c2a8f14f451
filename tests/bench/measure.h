#pragma once
#include <chrono>
#include <utility>
#include <vector>

/// Time, and what is told of many measurements.
namespace tyndall::bench {

using Clock = std::chrono::steady_clock;

/// Seconds from one moment to another.
double seconds_between(Clock::time_point from, Clock::time_point to);

/// Wall time of a call in seconds.
template <class Call>
double seconds_of(Call&& call) {
  const Clock::time_point start = Clock::now();
  std::forward<Call>(call)();
  return seconds_between(start, Clock::now());
}

/// The value that `fraction` (in [0, 1]) of the values do not exceed, interpolated between neighbours; not a number for
/// none.
double quantile(std::vector<double> values, double fraction);
double median(std::vector<double> values);

}  // namespace tyndall::bench

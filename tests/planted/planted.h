#pragma once
#include <cstdlib>
#include <type_traits>

/// The number of the fault that this run of the program has, from the environment; 0 for none.
inline const int planted_fault = [] {
  const char* number = std::getenv("TYNDALL_FAULT");
  return number ? std::atoi(number) : 0;
}();

/// Whether it is this one. What the compiler works out has no faults.
constexpr bool is_planted(int number) { return !std::is_constant_evaluated() && planted_fault == number; }

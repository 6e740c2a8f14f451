#pragma once
#include <cstdlib>
#include <span>
#include <vector>

/// How much of a costly test is done: a part in ./test, all of it in ./test --all.
namespace tyndall::test {

/// Whether tests may take their time, because the environment's TYNDALL_THOROUGH lets them, as ./test --all does.
inline bool thorough() { return std::getenv("TYNDALL_THOROUGH") != nullptr; }

/// All cases where tests are thorough, else the first `quick` of them.
template <class Case, std::size_t count>
std::span<const Case> tried(const Case (&cases)[count], std::size_t quick) {
  return std::span<const Case>(cases).first(thorough() ? count : quick);
}

}  // namespace tyndall::test

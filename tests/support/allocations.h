#pragma once
#include <cstddef>

/// Counts how often something large is copied, by the memory that each copy asks for.
namespace tyndall::test {

/// Counts, while it lives, how often `new` is asked for exactly so many bytes, by any thread. For example, a copy of a
/// vector of 997 objects asks once for 997 * sizeof(Object); moving the vector asks for nothing. One at a time.
class AllocationCount {
 public:
  explicit AllocationCount(std::size_t bytes);
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;
  int count() const;
};

}  // namespace tyndall::test

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

/// While it lives, `new` throws std::bad_alloc for one request, the `number`-th from its making on (from 1), or for all
/// requests of exactly `size` bytes, by any thread. One at a time.
class AllocationRefusal {
 public:
  static AllocationRefusal of_number(long number) { return {number, 0}; }
  static AllocationRefusal of_size(std::size_t size) { return {0, size}; }
  ~AllocationRefusal();
  AllocationRefusal(const AllocationRefusal&) = delete;
  AllocationRefusal& operator=(const AllocationRefusal&) = delete;
  int refused() const;  ///< how many requests

 private:
  AllocationRefusal(long number, std::size_t size);
};

}  // namespace tyndall::test

#include "tests/support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> watched_bytes = 0;  // 0: none
std::atomic<int> seen = 0;

}  // namespace

void* operator new(std::size_t bytes) {
  if (bytes == watched_bytes.load(std::memory_order_relaxed) && bytes > 0) ++seen;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace tyndall::test {

AllocationCount::AllocationCount(std::size_t bytes) {
  seen = 0;
  watched_bytes = bytes;
}
AllocationCount::~AllocationCount() { watched_bytes = 0; }
int AllocationCount::count() const { return seen; }

}  // namespace tyndall::test

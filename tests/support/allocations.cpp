#include "tests/support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> watched_bytes = 0;  // 0: none
std::atomic<int> seen = 0;
std::atomic<long> until_refusal = 0;        // 0: none; 1: the next request
std::atomic<std::size_t> refused_size = 0;  // 0: none
std::atomic<int> refused_requests = 0;

bool is_refused(std::size_t bytes) {
  bool refused = bytes > 0 && bytes == refused_size.load(std::memory_order_relaxed);
  if (until_refusal.load(std::memory_order_relaxed) > 0) refused = --until_refusal == 0 || refused;
  if (refused) ++refused_requests;
  return refused;
}

}  // namespace

void* operator new(std::size_t bytes) {
  if (bytes == watched_bytes.load(std::memory_order_relaxed) && bytes > 0) ++seen;
  if (is_refused(bytes)) throw std::bad_alloc();
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
// Sanitizers bring one of their own, whose memory may not be given back by the operator delete below.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
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

AllocationRefusal::AllocationRefusal(long number, std::size_t size) {
  refused_requests = 0;
  until_refusal = number;
  refused_size = size;
}
AllocationRefusal::~AllocationRefusal() {
  until_refusal = 0;
  refused_size = 0;
}
int AllocationRefusal::refused() const { return refused_requests; }

}  // namespace tyndall::test

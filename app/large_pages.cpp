#include "core/system/process.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

/// The program's own operator new: large blocks, such as films, pictures and the columns of large scenes, are put on
/// large pages where the system has them. Each page costs a detour through the system when it is first touched, and in
/// a virtual machine a slow one: with pages of 4 KiB, a picture of 1280 x 720 spent longer on these than on 4 samples.
/// Smaller blocks, and what other libraries ask of malloc, are left alone.
namespace {

constexpr std::size_t usual_alignment = alignof(std::max_align_t);

using tyndall::allocate_aligned, tyndall::large_page;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (bytes >= large_page && bytes <= PTRDIFF_MAX && alignment <= large_page) {
    // The end is on a large page, too, where that wastes little.
    if (const std::size_t rest = -bytes % large_page; rest <= bytes / 8) bytes += rest;
    void* memory = allocate_aligned(bytes, large_page);
    if (memory) tyndall::ask_for_large_pages(memory, bytes);
    return memory;
  }
  if (bytes == 0) bytes = 1;
  return alignment <= usual_alignment ? std::malloc(bytes) : allocate_aligned(bytes, alignment);
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment) {
  if (void* memory = allocate(bytes, alignment)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate_or_throw(bytes, usual_alignment); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment));
}
// Sanitizers bring one of their own, whose memory may not be given back by the operator delete below.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, usual_alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

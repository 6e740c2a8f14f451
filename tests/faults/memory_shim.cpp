// A library that is loaded before the others (LD_PRELOAD) and refuses one request for memory, as the system does when
// there is none left. It counts all requests, also those of other libraries and of C.
//
//   MEMORY_AT=N       the request that is refused, counted from 1; 0: none
//   MEMORY_LOG=FILE   gets the number of requests when main() ends
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
// glibc's own, under the names that stay when these are replaced.
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

std::atomic<long> requests{0};
std::atomic<bool> counting{false};  // from the beginning of main() to its end
long refused = 0;

bool is_refused() {
  if (!counting.load(std::memory_order_relaxed)) return false;
  if (++requests != refused) return false;
  errno = ENOMEM;
  return true;
}

using Main = int (*)(int, char**, char**);
Main program = nullptr;

void write_log() {
  const char* file = std::getenv("MEMORY_LOG");
  const int log = file ? open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600) : -1;
  if (log < 0) return;
  char line[32];
  const int size = std::snprintf(line, sizeof line, "%ld\n", requests.load());
  (void)!write(log, line, static_cast<size_t>(size));
  close(log);
}

int counted_main(int count, char** words, char** environment) {
  const char* at = std::getenv("MEMORY_AT");
  refused = at ? std::atol(at) : 0;
  counting = true;
  const int code = program(count, words, environment);
  counting = false;
  write_log();
  return code;
}

}  // namespace

extern "C" {

/// Calls main().
int __libc_start_main(Main main, int count, char** words, Main initialise, void (*finish)(), void (*loader_finish)(),
                      void* stack_end) {
  program = main;
  void* found = dlsym(RTLD_NEXT, "__libc_start_main");
  decltype(&__libc_start_main) next = nullptr;
  std::memcpy(&next, &found, sizeof found);
  return next(counted_main, count, words, initialise, finish, loader_finish, stack_end);
}

void* malloc(size_t size) { return is_refused() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return is_refused() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return is_refused() ? nullptr : __libc_realloc(memory, size); }
void* memalign(size_t alignment, size_t size) { return is_refused() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  *memory = memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

}  // extern "C"

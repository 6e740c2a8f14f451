// A library that is loaded before the others (LD_PRELOAD) and stands between the program and the system: it counts the
// calls that concern files below one folder, and at a chosen one ends the program or lets the call fail.
//
//   FAULT_UNDER=FOLDER      whose files are meant (absolute, without links)
//   FAULT_LOG=FILE          gets the name of each call, a line each, when it has returned
//   FAULT_AT=N              the call that is meant, counted from 1
//   FAULT_MODE=MODE         before, after: the program is killed at this place, as by a power cut; half: it is killed
//                           when half of the bytes of a write are written; error: the call fails
//   FAULT_ERRNO=NUMBER      how it fails
//   FAULT_FOREVER=1         all later calls fail, too
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <class Function>
Function next(const char* name) {
  void* found = dlsym(RTLD_NEXT, name);
  Function function = nullptr;
  std::memcpy(&function, &found, sizeof found);
  return function;
}

struct Wish {
  const char* under = std::getenv("FAULT_UNDER");
  const char* mode = std::getenv("FAULT_MODE");
  long at = number("FAULT_AT");
  int error = static_cast<int>(number("FAULT_ERRNO"));
  bool forever = number("FAULT_FOREVER") != 0;
  int log = -1;

  Wish() {
    const char* file = std::getenv("FAULT_LOG");
    if (file)
      log = static_cast<int>(syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  }
  static long number(const char* name) {
    const char* text = std::getenv(name);
    return text ? std::atol(text) : 0;
  }
  bool is(const char* name) const { return mode && std::strcmp(mode, name) == 0; }
};

const Wish& wish() {
  static const Wish made;
  return made;
}

bool is_under(const char* path) {
  const char* under = wish().under;
  if (!under || !path) return false;
  const std::size_t size = std::strlen(under);
  if (path[0] == '/') return std::strncmp(path, under, size) == 0;
  char folder[PATH_MAX];
  return getcwd(folder, sizeof folder) && std::strncmp(folder, under, size) == 0;
}

bool is_under(int descriptor) {
  char link[64], path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = wish().under ? readlink(link, path, sizeof path - 1) : -1;
  if (size <= 0) return false;
  path[size] = '\0';
  return path[0] == '/' && is_under(path);
}

std::atomic<long> calls{0};

[[noreturn]] void die() {
  syscall(SYS_kill, getpid(), SIGKILL);
  for (;;) pause();
}

/// One call: counted when it is made, and what is wished happens around it.
class Call {
 public:
  template <class Where>
  Call(const char* name, Where where) : name_(name), meant_(is_under(where)), number_(meant_ ? ++calls : 0) {
    if (is_the_one() && wish().is("before")) die();
  }
  bool fails() const {
    if (!meant_ || !wish().is("error") || wish().at == 0) return false;
    const bool now = number_ == wish().at || (wish().forever && number_ > wish().at);
    if (now) note(" failed"), errno = wish().error;
    return now;
  }
  bool is_cut() const { return is_the_one() && wish().is("half"); }
  template <class Result>
  Result done(Result result) const {
    const int error = errno;
    if (meant_) note("");
    if (is_the_one() && wish().is("after")) die();
    errno = error;
    return result;
  }

 private:
  bool is_the_one() const { return meant_ && number_ == wish().at; }
  void note(const char* how) const {
    char line[80];
    const int size = std::snprintf(line, sizeof line, "%s%s\n", name_, how);
    if (wish().log >= 0) (void)!syscall(SYS_write, wish().log, line, size);
  }

  const char* name_;
  bool meant_;
  long number_;
};

/// A call of the system, as it is wished.
template <class Result, class Where, class... Arguments>
Result make(const char* name, Where where, long number, Arguments... arguments) {
  const Call call(name, where);
  return call.fails() ? Result(-1) : call.done(static_cast<Result>(syscall(number, arguments...)));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return make<int>("open", path, SYS_openat, AT_FDCWD, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  static const auto real = next<FILE* (*)(const char*, const char*)>("fopen");
  const Call call("fopen", path);
  return call.fails() ? nullptr : call.done(real(path, mode));
}

ssize_t read(int descriptor, void* bytes, size_t count) {
  return make<ssize_t>("read", descriptor, SYS_read, descriptor, bytes, count);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  const Call call("write", descriptor);
  if (call.fails()) return -1;
  if (call.is_cut()) {
    (void)!syscall(SYS_write, descriptor, bytes, count / 2);
    die();
  }
  return call.done(syscall(SYS_write, descriptor, bytes, count));
}

off_t lseek(int descriptor, off_t offset, int whence) noexcept {
  return make<off_t>("lseek", descriptor, SYS_lseek, descriptor, offset, whence);
}

int fsync(int descriptor) { return make<int>("fsync", descriptor, SYS_fsync, descriptor); }

int rename(const char* from, const char* to) noexcept {
  return make<int>("rename", to, SYS_renameat, AT_FDCWD, from, AT_FDCWD, to);
}

int unlink(const char* path) noexcept { return make<int>("unlink", path, SYS_unlinkat, AT_FDCWD, path, 0); }

int close(int descriptor) {
  const Call call("close", descriptor);
  const int result = static_cast<int>(syscall(SYS_close, descriptor));  // a failing close closes all the same
  return call.fails() ? -1 : call.done(result);
}

int flock(int descriptor, int operation) noexcept {
  return make<int>("flock", descriptor, SYS_flock, descriptor, operation);
}

int fchmod(int descriptor, mode_t mode) noexcept {
  return make<int>("fchmod", descriptor, SYS_fchmod, descriptor, mode);
}

int fstat(int descriptor, struct stat* status) noexcept {
  return make<int>("fstat", descriptor, SYS_fstat, descriptor, status);
}

int stat(const char* path, struct stat* status) noexcept {
  return make<int>("stat", path, SYS_newfstatat, AT_FDCWD, path, status, 0);
}

}  // extern "C"

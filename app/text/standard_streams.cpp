#include "app/text/standard_streams.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace tyndall {

void keep_standard_streams() {
  for (;;) {
    const int descriptor = open("/dev/null", O_RDONLY);  // the lowest that is free; for reading only: writing fails
    if (descriptor < 0) return;
    if (descriptor > STDERR_FILENO) {
      close(descriptor);
      return;
    }
  }
}

void write_standard_output(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw IoError("standard output: cannot write: " + std::generic_category().message(errno));
}

void complain(const std::string& text) { std::fprintf(stderr, "tyndall: %s\n", text.c_str()); }

}  // namespace tyndall

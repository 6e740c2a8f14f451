#include "app/text/standard_streams.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/open_file.h"

#include <cerrno>
#include <cstdio>
#include <new>

namespace tyndall {

void write_standard_output(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw IoError("standard output: cannot write: " + error_text(errno));
}

void complain(std::string_view text) {
  constexpr std::size_t longest_message = 10000;  // bytes: two of the longest names of files, and what is said of them
  try {
    std::fprintf(stderr, "tyndall: %s\n", printable(text, longest_message).c_str());
  } catch (const std::bad_alloc&) {
    std::fputs("tyndall: not enough memory for a longer message\n", stderr);
  }
}

}  // namespace tyndall

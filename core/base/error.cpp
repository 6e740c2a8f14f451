#include "core/base/error.h"

#include "core/base/text.h"
#include "core/system/processors.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace tyndall {
namespace {

std::string gigabytes(std::uint64_t bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g GB", 1e-9 * static_cast<double>(bytes));
  return text.data();
}

}  // namespace

SceneError::SceneError(const std::string& file_, const std::string& where_, const std::string& found_,
                       const std::string& expected_)
    : runtime_error(printable(file_) + ": " + (where_.empty() ? "" : printable(where_) + ": ") + "found " +
                    printable(found_) + ", expected " + printable(expected_, 600)),
      file(file_),
      where(where_),
      found(found_),
      expected(expected_) {}

SceneError::SceneError(const std::string& file_, const std::string& found_, const std::string& expected_)
    : SceneError(file_, "", found_, expected_) {}

std::string memory_limit_text() {
  const std::uint64_t space = limit_of(Limit::address_space), data = limit_of(Limit::data);
  std::string text;
  if (space < no_limit) text += " (the address space is limited to " + gigabytes(space) + ": ulimit -v)";
  if (data < no_limit) text += " (data are limited to " + gigabytes(data) + ": ulimit -d)";
  return text;
}

std::string thread_limit_text() {
  const std::uint64_t threads = limit_of(Limit::threads);
  const std::string memory = memory_limit_text();
  return (threads < no_limit ? "; this user may have " + std::to_string(threads) + " threads and processes: ulimit -u"
                             : "") +
         (memory.empty() ? "" : ";" + memory);
}

}  // namespace tyndall

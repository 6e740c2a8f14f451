#include "tests/bench/machine.h"

#include "core/system/processors.h"
#include "core/targets/kernels.h"

#include <algorithm>
#include <fstream>

namespace tyndall::bench {
namespace {

/// What the operating system calls the processor; "unknown" where it does not say.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return __VERSION__;
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace

Json machine() {
  Json json;
  json["version"] = TYNDALL_VERSION;
  json["compiler"] = compiler();
  json["processor"] = processor();
  json["cores"] = thread_count().count;
  json["instruction_sets"] = Json::array();
  for (const Kernels& kernels : available_kernels()) json["instruction_sets"].push_back(kernels.isa);
  return json;
}

int threads_up_to(int maximum) { return std::min(thread_count().count, std::max(maximum, 1)); }

}  // namespace tyndall::bench

// Command lines: each line of the input is an argument.
#include "app/cli/requests.h"
#include "app/text/values.h"
#include "tests/fuzz/fuzz_input.h"

#include <sstream>

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments;
  std::istringstream in{std::string(fuzz::text_of(data, size))};
  for (std::string line; std::getline(in, line);) arguments.push_back(line);
  fuzz::survives<UsageError>([&] { read_command(arguments); });
  return 0;
}

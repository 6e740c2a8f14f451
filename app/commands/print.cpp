#include "app/commands/commands.h"
#include "app/standard_streams.h"

namespace tyndall {

int run(const PrintCommand& command) {
  write_standard_output(command.text);
  return 0;
}

}  // namespace tyndall

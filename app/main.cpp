#include "app/cli/requests.h"
#include "app/files/outputs.h"
#include "core/system/process.h"

#include <exception>

int main(int argc, char** argv) {
  tyndall::begin_process();
  try {
    const tyndall::CommandRequest command = tyndall::read_command(tyndall::program_arguments(argc, argv));
    return command.run(command);
  } catch (const std::exception&) {
    return tyndall::told_exit_code();
  }
}

#include "app/book/book_folder.h"
#include "app/cli/commands.h"
#include "app/text/standard_streams.h"

namespace tyndall {

int run(const PrintCommand& command) {
  write_standard_output(command.text);
  return 0;
}

int run(const BookCommand&) {
  write_standard_output(book_folder().string() + "\n");
  return 0;
}

}  // namespace tyndall

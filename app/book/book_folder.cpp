#include "app/book/book_folder.h"

#include "core/base/error.h"
#include "core/system/files.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

fs::path book_folder() {
  std::error_code error;
  const fs::path program = own_file().parent_path();
  const char* assets = std::getenv("TYNDALL_ASSETS");
  const fs::path chosen = assets && *assets ? fs::path(assets) / "book" : fs::path();
  for (const fs::path& folder : {chosen, program.parent_path() / "share" / "tyndall" / "book", program / "book"})
    if (!folder.empty() && fs::is_regular_file(folder / "take.h", error)) return folder;
  throw IoError(
      "the folder of headers for readers' programs was not found: neither share/tyndall/book of the installation nor " +
      (program / "book").string() + " has take.h");
}

}  // namespace tyndall

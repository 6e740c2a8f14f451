#include "app/book/scratch_folder.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/files.h"
#include "core/system/open_file.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  int problem = 0;
  const fs::path made = make_temporary_folder("tyndall-book-", &problem);
  if (made.empty())
    throw IoError(printable(temporary_folder().string()) + ": cannot make a temporary folder: " + error_text(problem));
  std::error_code error;
  path_ = fs::canonical(made, error);
  if (error) path_ = made;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  if (!error) return;
  for (fs::recursive_directory_iterator at(path_, error), end; !error && at != end; at.increment(error))
    fs::permissions(at->path(), fs::perms::owner_all, fs::perm_options::add, error);  // a program took them away
  fs::remove_all(path_, error);
}

void ScratchFolder::write(const fs::path& name, const std::string& text) const { write_text(path_ / name, text); }

void write_text(const fs::path& file, const std::string& text) {
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out || error)
    throw IoError(printable(file.parent_path().string()) +
                  ": cannot write temporary files: " + error_text(error ? error.value() : errno));
}

std::string read_text(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw IoError(printable(file.string()) + ": is no file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  if (!in.is_open() || in.bad()) throw IoError(printable(file.string()) + ": cannot be read: " + error_text(errno));
  return text;
}

}  // namespace tyndall

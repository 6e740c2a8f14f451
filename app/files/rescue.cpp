#include "app/files/outputs.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/whole_file.h"

#include <cstdlib>
#include <fstream>
#include <span>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// A name beside the file that nothing has; empty: there is none.
fs::path free_name(const fs::path& file) {
  std::error_code error;
  for (int number = 1; number < 1000; ++number) {
    fs::path name = beside(file, number == 1 ? "new" : "new-" + std::to_string(number));
    if (fs::symlink_status(name, error).type() == fs::file_type::not_found) return name;
  }
  return {};
}

/// The file's name in a new folder among the temporary files; empty: none can be made.
fs::path temporary_name(const fs::path& file) {
  std::error_code error;
  std::string folder = (fs::temp_directory_path(error) / "tyndall-XXXXXX").string();
  return error || !mkdtemp(folder.data()) ? fs::path() : folder / file.filename();
}

bool succeeds(const std::function<void(const fs::path& file)>& write, const fs::path& file) {
  if (file.empty()) return false;
  try {
    write(file);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

void write_or_rescue(const fs::path& file, const std::function<void(const fs::path& file)>& write) {
  const auto at = [](const std::string& problem, const fs::path& place) {
    return ImageFileError(problem + "; it is in " + place.string() + " instead");
  };
  try {
    return write(file);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (is_stream(file)) throw;
    const std::string problem = error.what();
    const fs::path near = free_name(file);
    if (succeeds(write, near)) throw at(problem, near);
    const fs::path far = temporary_name(file);
    if (succeeds(write, far)) throw at(problem, far);
    std::error_code ignored;
    if (!far.empty()) fs::remove(far.parent_path(), ignored);
    throw;
  }
}

void write_text_or_rescue(const fs::path& file, const std::string& text) {
  write_or_rescue(file, [&text](const fs::path& to) { write_text_file(to, text); });
}

bool written_or_told(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    complain(printable(error.what(), 2000));
    return false;
  }
}

void write_copy(const fs::path& from, const fs::path& to) {
  std::ifstream in(from, std::ios::binary);
  if (!in) throw IoError(from.string() + ": cannot read");
  WholeFile out(to);
  std::vector<char> bytes(std::size_t{1} << 16);
  while (in) {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    out.write(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), got));
  }
  if (!in.eof()) throw IoError(from.string() + ": cannot read");
  out.commit();
}

}  // namespace tyndall

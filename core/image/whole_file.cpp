#include "core/image/whole_file.h"

#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/image/image_io_file.h"
#include "core/system/files.h"
#include "core/system/processors.h"

#include <algorithm>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Follows symbolic links to a name that is none, or to one that stands for an open file.
fs::path end_of_links(const fs::path& file) {
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error) && !is_open_file(target); ++links) {
    if (links == 40) cannot_write(file, error_text(ELOOP));
    target = target.parent_path() / fs::read_symlink(target, error);
    if (error) cannot_write(file, error.message());
  }
  return target;
}

/// What keeps the ordinary file at place.target from being replaced; "": nothing that is known beforehand.
std::string obstacle_of(const FilePlace& place) {
  if (is_mount_point(place.target)) return "it is a mount point";
  if (const std::string only = protection_of(place.target); !only.empty()) return "it may " + only;
  if (!place.folder_problem.empty()) return place.folder_problem;
  return is_kept_by_sticky_folder(place.target, place.folder)
             ? "it is another user's file in a folder with the sticky bit"
             : "";
}

constexpr std::size_t buffer_size = std::size_t{1} << 20;
constexpr const char* temporary_mark = ".tmp-";
constexpr std::size_t digits_of_number = 16;

/// What the names of all temporary files of a target begin with: its name, or if that would become too long, its
/// beginning and the hash of all of it.
std::string temporary_prefix(const fs::path& folder, const std::string& name) {
  const std::size_t room = longest_name(folder) - std::string(temporary_mark).size() - digits_of_number;
  if (name.size() <= room) return name + temporary_mark;
  const std::string beginning = name.substr(0, size_of_letters(name, room - 1 - digits_of_number));
  return beginning + '~' + hash_text(fnv1a(name)) + temporary_mark;
}

/// Removes what killed writers of the same file have left: their locks are free. What cannot be read or removed is left
/// to the next writer.
void remove_dead(const fs::path& folder, const std::string& prefix) {
  for (const std::string& name : names_in_folder(folder)) {
    const bool ours = name.size() == prefix.size() + digits_of_number && name.starts_with(prefix) &&
                      name.find_first_not_of("0123456789abcdef", prefix.size()) == std::string::npos;
    const OpenFile file = ours ? OpenFile(folder / name, OpenFor::looking) : OpenFile();
    if (file && file.lock() == 0) remove_file(folder / name);
  }
}

}  // namespace

FilePlace find_place(const fs::path& file) {
  FilePlace place;
  place.method = file == "-" ? WriteMethod::stream : WriteMethod::replace;
  place.target = file;
  if (file == "-") return place;
  if (const std::string problem = problem_of_name(file); !problem.empty()) cannot_write(file, problem);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const bool there = !error;
  if (!there && error != std::errc::no_such_file_or_directory) cannot_write(file, error.message());
  place.target = end_of_links(file);
  place.folder = place.target.has_parent_path() ? place.target.parent_path() : fs::path(".");
  if (!place.target.has_filename()) cannot_write(file, error_text(EISDIR));
  if (const std::string only = protection_of(place.folder); !only.empty())
    place.folder_problem = "its folder may " + only;
  if (!there && !place.folder_problem.empty()) cannot_write(file, place.folder_problem);
  if (!there) return place;
  place.exists = true;
  if (fs::is_directory(status)) cannot_write(file, error_text(EISDIR));
  const bool once = fs::is_fifo(status) || fs::is_character_file(status) || fs::is_symlink(place.target, error);
  if (!once && !fs::is_regular_file(status)) cannot_write(file, "not an ordinary file");
  if (const int problem = once ? writing_error(file) : 0) cannot_write(file, error_text(problem));
  if (once) place.method = WriteMethod::stream;
  if (!once) place.obstacle = obstacle_of(place);
  if (!place.obstacle.empty()) place.method = WriteMethod::in_place;
  return place;
}

bool is_stream(const fs::path& file) {
  try {
    return find_place(file).method == WriteMethod::stream;
  } catch (const ImageFileError&) {
    return false;  // writing it says why
  }
}

fs::path beside(const fs::path& file, const std::string& mark) {
  return file.parent_path() / (file.stem().string() + "." + mark + file.extension().string());
}

void WholeFile::fail(int number) const { cannot_write(file_, error_text(number)); }

void WholeFile::check(int error) const {
  if (error != 0) fail(error);
}

WholeFile::WholeFile(const fs::path& file) : file_(file), place_(find_place(file)) {
  buffer_.reserve(buffer_size);
  if (place_.method == WriteMethod::in_place) check_in_place();
  if (place_.method != WriteMethod::stream && place_.folder_problem.empty()) open_beside();
  if (bytes_) return;
  if (place_.method == WriteMethod::in_place) check_in_place();  // as open_beside() may have found
  bytes_ = OpenFile::unnamed();
  check(bytes_.error());
}

/// Leaves bytes_ closed where the folder takes no new files, but the file may be written into.
void WholeFile::open_beside() {
  const std::string prefix = temporary_prefix(place_.folder, place_.target.filename().string());
  remove_dead(place_.folder, prefix);
  std::random_device random;  // where another writer has the same number, O_EXCL tells, and the next one is taken
  for (int attempt = 0; attempt < 1000; ++attempt)
    if (create(place_.folder / (prefix + hash_text(std::uint64_t{random()} << 32 | random())))) return;
  if (place_.method == WriteMethod::replace) fail(EEXIST);
}

/// Throws unless the file can be opened for writing.
void WholeFile::check_in_place() {
  const OpenFile file(place_.target, OpenFor::writing);
  if (file) return;
  if (place_.obstacle.empty()) fail(file.error());
  cannot_write(file_, place_.obstacle + ", and into it: " + error_text(file.error()));
}

/// Creates and locks a temporary file, or finds that the folder takes none. False if there is one of that name, or if
/// another writer took it for a dead one and removed it between the two steps.
bool WholeFile::create(const fs::path& temporary) {
  temporary_ = temporary;                               // while there is no file: memory for the name may run out
  const unsigned mode = place_.exists ? 0600u : 0666u;  // what replaces a private file is private while it is written
  OpenFile file(temporary, OpenFor::creating, mode);
  const int why = file.error();
  if (!file) temporary_.clear();
  if (!file && why == EEXIST) return false;
  const bool needless = place_.method == WriteMethod::in_place || why == EACCES || why == EPERM || why == EROFS;
  if (!file && place_.exists && needless) {
    place_.folder_problem = error_text(why);
    if (place_.obstacle.empty()) place_.obstacle = "its folder takes no new files";
    place_.method = WriteMethod::in_place;
    return true;
  }
  if (!file) fail(why);
  // Where files cannot be locked, nobody can lock them in order to remove them, either.
  if (file.lock() == EWOULDBLOCK || !file.has_name()) {
    temporary_.clear();
    return false;
  }
  bytes_ = std::move(file);
  return true;
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) remove_file(temporary_);
}

void WholeFile::write(std::span<const std::byte> bytes) {
  position_ += bytes.size();
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), buffer_size - buffer_.size()));
    buffer_.insert(buffer_.end(), part.begin(), part.end());
    bytes = bytes.subspan(part.size());
    if (buffer_.size() == buffer_size) flush();
  }
}

void WholeFile::flush() {
  check(bytes_.write(buffer_.data(), buffer_.size()));
  buffer_.clear();
}

void WholeFile::seek(std::uint64_t position) {
  flush();
  check(bytes_.seek(position));
  position_ = position;
}

/// Copies all that was written to an open file.
void WholeFile::copy_to(const OpenFile& to) const {
  check(bytes_.seek(0));
  std::vector<std::byte> part(std::size_t{1} << 16);
  for (std::size_t got = 1; got > 0;) {
    check(bytes_.read(part.data(), part.size(), got));
    check(to.write(part.data(), got));
  }
}

/// Writes into the file that cannot be replaced.
void WholeFile::overwrite() const {
  OpenFile to(place_.target, OpenFor::writing);
  check(to.error());
  std::uint64_t size = 0;
  check(bytes_.size(size));
  check(to.reserve(size));
  try {
    copy_to(to);
    check(to.truncate(size));
    check(to.synchronise());
    if (const int problem = to.close(); problem != EINTR) check(problem);
  } catch (const ImageFileError& error) {
    throw ImageFileError(std::string(error.what()) + "; what it holds now is neither the old file nor the new one");
  }
}

void WholeFile::commit() {
  flush();
  if (place_.method == WriteMethod::stream) {  // standard output, a pipe or device, or the end of a file open elsewhere
    OpenFile to = file_ == "-" ? OpenFile(standard_output) : OpenFile(file_, OpenFor::appending);
    check(to.error());
    copy_to(to);
    return check(to.close());
  }
  if (place_.method == WriteMethod::in_place) return overwrite();
  if (place_.exists) check(bytes_.take_mode_and_owner(place_.target));
  check(bytes_.synchronise());
  check(replace_file(temporary_, place_.target));
  temporary_.clear();
  const OpenFile folder(place_.folder, OpenFor::folder);
  if (folder.error() != EACCES)  // a folder into which one may write, but not look
    check(folder ? folder.synchronise() : folder.error());
  if (const int problem = bytes_.close(); problem != EINTR) check(problem);  // last, as closing unlocks
}

}  // namespace tyndall

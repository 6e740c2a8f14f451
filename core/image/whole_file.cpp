#include "core/image/whole_file.h"

#include "core/base/fnv1a.h"
#include "core/image/image_io_file.h"
#include "core/system/files.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t{1} << 20;
constexpr const char* temporary_mark = ".tmp-";
constexpr std::size_t digits_of_number = 16;

std::string hexadecimal(std::uint64_t number) {
  char text[digits_of_number + 1];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

/// A number that another writer of the same file hardly has, too. If it has, O_EXCL tells, and the next one is taken.
std::uint64_t likely_unique() {
  static std::atomic<std::uint64_t> count{0};
  const auto now = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count());
  return fnv1a(std::to_string(now) + ' ' + std::to_string(process_number()) + ' ' + std::to_string(++count));
}

/// What the names of all temporary files of a target begin with: its name, or if that would become too long, its
/// beginning and the hash of all of it.
std::string temporary_prefix(const fs::path& folder, const std::string& name) {
  const std::size_t room = longest_name(folder) - std::string(temporary_mark).size() - digits_of_number;
  if (name.size() <= room) return name + temporary_mark;
  std::size_t cut = room - 1 - digits_of_number;
  while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xc0) == 0x80) --cut;  // no half letters of UTF-8
  return name.substr(0, cut) + '~' + hexadecimal(fnv1a(name)) + temporary_mark;
}

/// Removes what killed writers of the same file have left: their locks are free. What cannot be read or removed is left
/// to the next writer.
void remove_dead(const fs::path& folder, const std::string& prefix) {
  for (const std::string& name : names_in_folder(folder)) {
    const bool ours = name.size() == prefix.size() + digits_of_number && name.starts_with(prefix) &&
                      name.find_first_not_of("0123456789abcdef", prefix.size()) == std::string::npos;
    const OpenFile file = ours ? OpenFile(folder / name, OpenFor::looking) : OpenFile();
    if (file && file.try_lock() == 0) remove_file(folder / name);
  }
}

}  // namespace

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
  open_unnamed();
}

/// Leaves bytes_ closed where the folder takes no new files, but the file may be written into.
void WholeFile::open_beside() {
  const std::string prefix = temporary_prefix(place_.folder, place_.target.filename().string());
  remove_dead(place_.folder, prefix);
  for (int attempt = 0; attempt < 1000; ++attempt)
    if (create(place_.folder / (prefix + hexadecimal(likely_unique())))) return;
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
  if (file.try_lock() == EWOULDBLOCK || !file.has_name()) {
    temporary_.clear();
    return false;
  }
  bytes_ = std::move(file);
  return true;
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) remove_file(temporary_);
}

void WholeFile::put(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  position_ += size;
  while (size > 0) {
    const std::size_t part = std::min(size, buffer_size - buffer_.size());
    buffer_.insert(buffer_.end(), bytes, bytes + part);
    bytes += part, size -= part;
    if (buffer_.size() == buffer_size) flush();
  }
}

void WholeFile::write(std::span<const std::uint8_t> bytes) { put(bytes.data(), bytes.size()); }
void WholeFile::write(std::span<const float> values) { put(values.data(), values.size_bytes()); }

void WholeFile::flush() {
  check(bytes_.write(buffer_.data(), buffer_.size()));
  buffer_.clear();
}

void WholeFile::seek(std::uint64_t position) {
  flush();
  check(bytes_.seek(position));
  position_ = position;
}

void WholeFile::sync_folder() const {
  const OpenFile folder(place_.folder, OpenFor::folder);
  if (folder.error() == EACCES) return;  // a folder into which one may write, but not look
  check(folder ? folder.synchronise() : folder.error());
}

void WholeFile::open_unnamed() {
  bytes_ = OpenFile::unnamed();
  check(bytes_.error());
}

/// Copies all that was written to an open file.
void WholeFile::copy_to(const OpenFile& to) const {
  check(bytes_.seek(0));
  std::vector<std::uint8_t> part(std::size_t{1} << 16);
  for (std::size_t got = 1; got > 0;) {
    check(bytes_.read(part.data(), part.size(), got));
    check(to.write(part.data(), got));
  }
}

/// Copies what was written to standard output, into a pipe or device, or to the end of a file that is open elsewhere.
void WholeFile::send() const {
  OpenFile to = file_ == "-" ? OpenFile(standard_output) : OpenFile(file_, OpenFor::appending);
  check(to.error());
  copy_to(to);
  check(to.close());
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
  if (place_.method == WriteMethod::stream) return send();
  if (place_.method == WriteMethod::in_place) return overwrite();
  if (place_.exists) check(bytes_.set_owner(place_.mode, place_.owner.user, place_.owner.group));
  check(bytes_.synchronise());
  check(replace_file(temporary_, place_.target));
  temporary_.clear();
  sync_folder();
  if (const int problem = bytes_.close(); problem != EINTR) check(problem);  // last, as closing unlocks
}

}  // namespace tyndall

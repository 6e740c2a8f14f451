#include "core/image/whole_file.h"

#include "core/base/fnv1a.h"
#include "core/image/image_io_file.h"

#include <sys/file.h>
#include <sys/stat.h>
#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

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
  return fnv1a(std::to_string(now) + ' ' + std::to_string(getpid()) + ' ' + std::to_string(++count));
}

/// What the names of all temporary files of a target begin with: its name, or if that would become too long, its
/// beginning and the hash of all of it.
std::string temporary_prefix(const fs::path& folder, const std::string& name) {
  const long longest = pathconf(folder.c_str(), _PC_NAME_MAX);
  const std::size_t limit = longest > 64 ? static_cast<std::size_t>(longest) : 255;
  const std::size_t room = limit - std::string(temporary_mark).size() - digits_of_number;
  if (name.size() <= room) return name + temporary_mark;
  std::size_t cut = room - 1 - digits_of_number;
  while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xc0) == 0x80) --cut;  // no half letters of UTF-8
  return name.substr(0, cut) + '~' + hexadecimal(fnv1a(name)) + temporary_mark;
}

/// Removes a temporary file if no living process holds its lock.
void remove_if_dead(const fs::path& temporary) {
  const int descriptor = open(temporary.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(temporary.c_str());
  close(descriptor);
}

struct FolderCloser {
  void operator()(DIR* folder) const { closedir(folder); }
};

/// Removes what killed writers of the same file have left. What cannot be read or removed is left to the next writer.
/// (Not by std::filesystem, whose iterator ends the program when memory runs out.)
void remove_dead(const fs::path& folder, const std::string& prefix) {
  const std::unique_ptr<DIR, FolderCloser> entries(opendir(folder.c_str()));
  for (const dirent* entry = nullptr; entries && (entry = readdir(entries.get())) != nullptr;) {
    const std::string_view name = entry->d_name;
    const bool ours = name.size() == prefix.size() + digits_of_number && name.starts_with(prefix) &&
                      name.find_first_not_of("0123456789abcdef", prefix.size()) == std::string_view::npos;
    if (ours) remove_if_dead(folder / name);
  }
}

/// 0, or what went wrong.
int write_all(int descriptor, const std::uint8_t* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes += written, size -= static_cast<std::size_t>(written);
  }
  return 0;
}

/// 0, or what went wrong. Some file systems cannot synchronise folders, and say so in one of these ways.
int sync_error(int descriptor, bool is_folder) {
  while (fsync(descriptor) != 0) {
    if (errno == EINTR) continue;
    return is_folder && (errno == EINVAL || errno == ENOTSUP) ? 0 : errno;
  }
  return 0;
}

/// A file that is open in a scope.
struct Opened {
  int descriptor;
  ~Opened() { close(); }
  int close() { return descriptor > 2 ? ::close(std::exchange(descriptor, -1)) : 0; }
};

/// Asks the disk for room, so that it is not missed in the middle. 0, or what went wrong. Some file systems do not say.
int reserve(int descriptor, std::uint64_t size) {
#ifdef __linux__
  while (size > 0 && fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size)) != 0) {
    if (errno == EINTR) continue;
    return errno == EOPNOTSUPP || errno == ENOSYS || errno == EINVAL ? 0 : errno;
  }
#endif
  return 0;
}

}  // namespace

void WholeFile::fail(int number) const { cannot_write(file_, std::generic_category().message(number)); }

WholeFile::WholeFile(const fs::path& file) : file_(file), place_(find_place(file)) {
  buffer_.reserve(buffer_size);
  if (place_.method == WriteMethod::in_place) check_in_place();
  if (place_.method != WriteMethod::stream && place_.folder_problem.empty()) open_beside();
  if (descriptor_ >= 0) return;
  if (place_.method == WriteMethod::in_place) check_in_place();  // as open_beside() may have found
  open_unnamed();
}

/// Leaves descriptor_ < 0 where the folder takes no new files, but the file may be written into.
void WholeFile::open_beside() {
  const std::string prefix = temporary_prefix(place_.folder, place_.target.filename().string());
  remove_dead(place_.folder, prefix);
  for (int attempt = 0; attempt < 1000; ++attempt)
    if (create(place_.folder / (prefix + hexadecimal(likely_unique())))) return;
  if (place_.method == WriteMethod::replace) fail(EEXIST);
}

/// Throws unless the file can be opened for writing.
void WholeFile::check_in_place() {
  const int file = open(place_.target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (file < 0) {
    const int error = errno;
    if (place_.obstacle.empty()) fail(error);
    cannot_write(file_, place_.obstacle + ", and into it: " + std::generic_category().message(error));
  }
  close(file);
}

/// Creates and locks a temporary file, or finds that the folder takes none. False if there is one of that name, or if
/// another writer took it for a dead one and removed it between the two steps.
bool WholeFile::create(const fs::path& temporary) {
  temporary_ = temporary;                           // while there is no file: memory for the name may run out
  const mode_t mode = place_.exists ? 0600 : 0666;  // what replaces a private file is private while it is written
  const int descriptor = open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) temporary_.clear();
  if (descriptor < 0 && errno == EEXIST) return false;
  const bool needless = place_.method == WriteMethod::in_place || errno == EACCES || errno == EPERM || errno == EROFS;
  if (descriptor < 0 && place_.exists && needless) {
    place_.folder_problem = std::generic_category().message(errno);
    if (place_.obstacle.empty()) place_.obstacle = "its folder takes no new files";
    place_.method = WriteMethod::in_place;
    return true;
  }
  if (descriptor < 0) fail(errno);
  // Where files cannot be locked, nobody can lock them in order to remove them, either.
  const bool taken = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  struct stat status {};
  if (taken || (fstat(descriptor, &status) == 0 && status.st_nlink == 0)) {
    close(descriptor);
    temporary_.clear();
    return false;
  }
  descriptor_ = descriptor;
  return true;
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
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
  if (const int error = write_all(descriptor_, buffer_.data(), buffer_.size())) fail(error);
  buffer_.clear();
}

void WholeFile::seek(std::uint64_t position) {
  flush();
  if (lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) fail(errno);
  position_ = position;
}

/// Gives the new file the owner, group and mode of the one that it replaces, as far as that is permitted. What a group
/// was allowed is not given to another group.
void WholeFile::keep_owner() const {
  struct stat now {};
  if (!place_.exists) return;
  if (fstat(descriptor_, &now) != 0) fail(errno);
  unsigned mode = place_.mode;
  const bool same_group = now.st_gid == place_.group || fchown(descriptor_, now.st_uid, place_.group) == 0;
  if (!same_group) mode = (mode & ~070u) | ((mode & 7u) << 3);
  const bool same_user = now.st_uid == place_.user || fchown(descriptor_, place_.user, static_cast<gid_t>(-1)) == 0;
  if (!same_user || !same_group) mode &= 0777u;  // nobody becomes what the old owner was by running the file
  if ((now.st_mode & 07777u) == mode || fchmod(descriptor_, mode) == 0) return;
  if (errno != EPERM && errno != ENOTSUP) fail(errno);  // these two: the file system has no modes
}

void WholeFile::sync_folder() const {
  const int folder = open(place_.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0 && errno == EACCES) return;  // a folder into which one may write, but not look
  if (folder < 0) fail(errno);
  const int error = sync_error(folder, true);
  close(folder);
  if (error != 0) fail(error);
}

void WholeFile::open_unnamed() {
  const std::unique_ptr<std::FILE, Closer> file(std::tmpfile());
  descriptor_ = file ? fcntl(fileno(file.get()), F_DUPFD_CLOEXEC, 3) : -1;
  if (descriptor_ < 0) fail(errno);
}

/// Copies all that was written to an open file.
void WholeFile::copy_to(int to) const {
  if (lseek(descriptor_, 0, SEEK_SET) < 0) fail(errno);
  std::vector<std::uint8_t> bytes(std::size_t{1} << 16);
  for (;;) {
    const ssize_t got = read(descriptor_, bytes.data(), bytes.size());
    if (got == 0) return;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(errno);
    if (const int problem = write_all(to, bytes.data(), static_cast<std::size_t>(got))) fail(problem);
  }
}

/// Copies what was written to standard output, into a pipe or device, or to the end of a file that is open elsewhere.
void WholeFile::send() const {
  Opened to{file_ == "-" ? STDOUT_FILENO : open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY)};
  if (to.descriptor < 0) fail(errno);
  copy_to(to.descriptor);
  if (to.close() != 0) fail(errno);
}

/// Writes into the file that cannot be replaced.
void WholeFile::overwrite() const {
  Opened to{open(place_.target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY)};
  if (to.descriptor < 0) fail(errno);
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  if (size < 0) fail(errno);
  if (const int problem = reserve(to.descriptor, static_cast<std::uint64_t>(size))) fail(problem);
  try {
    copy_to(to.descriptor);
    if (ftruncate(to.descriptor, size) != 0) fail(errno);
    if (const int problem = sync_error(to.descriptor, false)) fail(problem);
    if (to.close() != 0 && errno != EINTR) fail(errno);
  } catch (const ImageFileError& error) {
    throw ImageFileError(std::string(error.what()) + "; what it holds now is neither the old file nor the new one");
  }
}

void WholeFile::commit() {
  flush();
  if (place_.method == WriteMethod::stream) return send();
  if (place_.method == WriteMethod::in_place) return overwrite();
  keep_owner();
  if (const int error = sync_error(descriptor_, false)) fail(error);
  if (rename(temporary_.c_str(), place_.target.c_str()) != 0) fail(errno);
  temporary_.clear();
  sync_folder();
  const int descriptor = descriptor_;  // closed last, as closing unlocks
  descriptor_ = -1;
  if (close(descriptor) != 0 && errno != EINTR) fail(errno);
}

}  // namespace tyndall

#include "core/system/open_file.h"

#include <sys/file.h>
#include <sys/stat.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace tyndall {
namespace {

constexpr int flags_for[] = {
    O_RDONLY,                          // reading
    O_WRONLY | O_NOCTTY,               // writing
    O_WRONLY | O_APPEND | O_NOCTTY,    // appending
    O_WRONLY | O_APPEND | O_CREAT,     // adding
    O_RDWR | O_CREAT,                  // changing
    O_RDWR | O_CREAT | O_EXCL,         // creating
    O_RDWR | O_NOFOLLOW | O_NONBLOCK,  // looking
    O_RDONLY | O_DIRECTORY,            // folder
};

int result(long value) { return value < 0 ? errno : 0; }

}  // namespace

std::string error_text(int number) { return std::generic_category().message(number); }

OpenFile::OpenFile(const std::filesystem::path& file, OpenFor purpose, unsigned mode)
    : descriptor_(open(file.c_str(), flags_for[static_cast<int>(purpose)] | O_CLOEXEC, mode)),
      error_(descriptor_ < 0 ? errno : 0) {}

OpenFile OpenFile::unnamed() {
  std::FILE* stream = std::tmpfile();
  OpenFile file(stream ? fcntl(fileno(stream), F_DUPFD_CLOEXEC, 3) : -1);
  if (!file) file.error_ = errno;
  if (stream) std::fclose(stream);
  return file;
}

int OpenFile::close() { return descriptor_ > STDERR_FILENO ? result(::close(std::exchange(descriptor_, -1))) : 0; }

int read_some(int file, void* to, std::size_t size, std::size_t& got) {
  ssize_t count = -1;
  do count = read(file, to, size);
  while (count < 0 && errno == EINTR);
  got = count > 0 ? static_cast<std::size_t>(count) : 0;
  return result(count);
}

int OpenFile::write(const void* bytes, std::size_t size) const {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t written = ::write(descriptor_, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    at += written, size -= static_cast<std::size_t>(written);
  }
  return 0;
}

int OpenFile::seek(std::uint64_t position) const {
  return result(lseek(descriptor_, static_cast<off_t>(position), SEEK_SET));
}

int OpenFile::size(std::uint64_t& bytes) const {
  struct stat status {};
  const int error = result(fstat(descriptor_, &status));
  bytes = static_cast<std::uint64_t>(status.st_size);
  return error;
}

int OpenFile::truncate(std::uint64_t size) const { return result(ftruncate(descriptor_, static_cast<off_t>(size))); }

/// Some file systems cannot synchronise folders, and say so in one of these ways.
int OpenFile::synchronise() const {
  struct stat status {};
  while (fsync(descriptor_) != 0) {
    const int error = errno;
    if (error == EINTR) continue;
    const bool is_folder = fstat(descriptor_, &status) == 0 && S_ISDIR(status.st_mode);
    return is_folder && (error == EINVAL || error == ENOTSUP) ? 0 : error;
  }
  return 0;
}

int OpenFile::reserve([[maybe_unused]] std::uint64_t size) const {
#ifdef __linux__
  while (size > 0 && fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size)) != 0) {
    if (errno == EINTR) continue;
    return errno == EOPNOTSUPP || errno == ENOSYS || errno == EINVAL ? 0 : errno;
  }
#endif
  return 0;
}

int OpenFile::lock(bool waits) const {
  int error = 0;
  do error = result(flock(descriptor_, waits ? LOCK_EX : LOCK_EX | LOCK_NB));
  while (error == EINTR);
  return error;
}

bool OpenFile::has_name() const {
  struct stat status {};
  return fstat(descriptor_, &status) != 0 || status.st_nlink > 0;
}

int OpenFile::take_mode_and_owner(const std::filesystem::path& other) const {
  struct stat now {};
  struct stat old {};
  if (fstat(descriptor_, &now) != 0) return errno;
  if (stat(other.c_str(), &old) != 0) return errno == ENOENT ? 0 : errno;
  mode_t mode = old.st_mode & 07777u;
  const bool same_group = now.st_gid == old.st_gid || fchown(descriptor_, now.st_uid, old.st_gid) == 0;
  if (!same_group) mode = (mode & ~070u) | ((mode & 7u) << 3);
  const bool same_user = now.st_uid == old.st_uid || fchown(descriptor_, old.st_uid, static_cast<gid_t>(-1)) == 0;
  if (!same_user || !same_group) mode &= 0777u;  // nobody becomes what the old owner was by running the file
  if ((now.st_mode & 07777u) == mode || fchmod(descriptor_, mode) == 0) return 0;
  return errno == EPERM || errno == ENOTSUP ? 0 : errno;  // these two: the file system has no modes
}

bool has_bytes(int file, int milliseconds) {
  pollfd watched{file, POLLIN, 0};
  return poll(&watched, 1, milliseconds) > 0;
}

}  // namespace tyndall

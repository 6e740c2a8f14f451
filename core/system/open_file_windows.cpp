#include "core/system/open_file.h"

#include "core/system/files.h"
#include "core/system/windows_api.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

namespace tyndall {
namespace {

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(_get_osfhandle(file)); }

struct HowToOpen {
  DWORD access, disposition, attributes;
  int flags;
};

constexpr DWORD all = GENERIC_READ | GENERIC_WRITE, append = FILE_APPEND_DATA | SYNCHRONIZE;
constexpr HowToOpen how_to_open[] = {
    {GENERIC_READ, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, 0},                          // reading
    {GENERIC_WRITE | FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, 0},  // writing
    {append, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, _O_APPEND},                        // appending
    {append, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, _O_APPEND},                          // adding
    {all, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, 0},                                     // changing
    {all, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, 0},                                      // creating
    {all, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, 0},                            // looking
    {GENERIC_READ, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, 0},                     // folder
};

int result(long long value) { return value < 0 ? errno : 0; }

unsigned at_once(std::size_t size) { return static_cast<unsigned>(std::min<std::size_t>(size, 1u << 30)); }

}  // namespace

int last_error_number(DWORD error) {
  if (error == ERROR_SHARING_VIOLATION || error == ERROR_LOCK_VIOLATION) return EBUSY;
  if (error == ERROR_FILE_EXISTS || error == ERROR_ALREADY_EXISTS) return EEXIST;
  if (error == ERROR_INVALID_NAME) return EINVAL;
  return std::system_category().default_error_condition(static_cast<int>(error)).value();
}

/// A file as a descriptor of the C library, or -1 and why.
static int open_file(const std::filesystem::path& file, const HowToOpen& how, int& error) {
  error = EINVAL;
  if (file.native().find(L'\0') != std::wstring::npos) return -1;
  const HANDLE handle =
      CreateFileW(file.c_str(), how.access, all_may, nullptr, how.disposition, how.attributes, nullptr);
  error = handle == INVALID_HANDLE_VALUE ? last_error_number() : 0;
  if (error != 0) return -1;
  const int number = _open_osfhandle(reinterpret_cast<std::intptr_t>(handle), how.flags | _O_BINARY | _O_NOINHERIT);
  if (number < 0) error = EMFILE, CloseHandle(handle);
  return number;
}

std::string error_text(int number) {
  if (number == EBUSY) return "another program holds it open";
  return number == ENOSYS ? "builds for Windows cannot do that" : std::generic_category().message(number);
}

OpenFile::OpenFile(const std::filesystem::path& file, OpenFor purpose, unsigned) {
  descriptor_ = open_file(file, how_to_open[static_cast<int>(purpose)], error_);
}

OpenFile OpenFile::unnamed() {
  OpenFile file;
  file.descriptor_ =
      open_file(temporary_folder() / (L"tyndall-" + unique_word()),
                {all | DELETE, CREATE_NEW, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, 0}, file.error_);
  return file;
}

int OpenFile::close() { return descriptor_ > 2 ? result(_close(std::exchange(descriptor_, -1))) : 0; }

int read_some(int file, void* to, std::size_t size, std::size_t& got) {
  const int count = _read(file, to, at_once(size));
  got = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count < 0 && errno == EPIPE ? 0 : result(count);
}

int OpenFile::write(const void* bytes, std::size_t size) const {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const int written = _write(descriptor_, at, at_once(size));
    if (written <= 0) return written < 0 ? errno : EIO;
    at += written, size -= static_cast<std::size_t>(written);
  }
  return 0;
}

int OpenFile::seek(std::uint64_t position) const {
  return result(_lseeki64(descriptor_, static_cast<long long>(position), SEEK_SET));
}

int OpenFile::size(std::uint64_t& bytes) const {
  const long long length = _filelengthi64(descriptor_);
  bytes = static_cast<std::uint64_t>(length);
  return result(length);
}

int OpenFile::truncate(std::uint64_t size) const { return _chsize_s(descriptor_, static_cast<long long>(size)); }

/// NTFS writes the names in a folder down by itself; pipes and devices have nothing to be written.
int OpenFile::synchronise() const {
  BY_HANDLE_FILE_INFORMATION info{};
  const bool known = GetFileInformationByHandle(handle_of(descriptor_), &info) != 0;
  if (known && (info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return 0;
  if (FlushFileBuffers(handle_of(descriptor_))) return 0;
  return GetLastError() == ERROR_INVALID_FUNCTION ? 0 : last_error_number();
}

int OpenFile::reserve(std::uint64_t) const { return 0; }

int OpenFile::lock(bool waits) const {
  OVERLAPPED place{};  // far beyond the end of any file: here locks keep others from reading and writing what is locked
  place.Offset = 0xfffffffe, place.OffsetHigh = 0x7fffffff;
  const DWORD flags = LOCKFILE_EXCLUSIVE_LOCK | (waits ? 0 : LOCKFILE_FAIL_IMMEDIATELY);
  if (LockFileEx(handle_of(descriptor_), flags, 0, 1, 0, &place)) return 0;
  const DWORD error = GetLastError();
  return error == ERROR_LOCK_VIOLATION || error == ERROR_IO_PENDING ? EWOULDBLOCK : last_error_number(error);
}

bool OpenFile::has_name() const {
  FILE_STANDARD_INFO info{};
  return !GetFileInformationByHandleEx(handle_of(descriptor_), FileStandardInfo, &info, sizeof info) ||
         (!info.DeletePending && info.NumberOfLinks > 0);
}

/// A file gets what its folder says; it has no mode.
int OpenFile::take_mode_and_owner(const std::filesystem::path&) const { return 0; }

/// Pipes cannot be waited for, so this asks now and then. What is no pipe can be read at once.
bool has_bytes(int file, int milliseconds) {
  for (int waited = 0;; waited += 10) {
    DWORD bytes = 0;
    if (!PeekNamedPipe(handle_of(file), nullptr, 0, nullptr, &bytes, nullptr) || bytes > 0) return true;
    if (waited >= milliseconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace tyndall

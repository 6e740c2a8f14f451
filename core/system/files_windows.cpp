#include "core/system/files.h"

#include "core/system/open_file.h"
#include "core/system/windows_api.h"

#include <fcntl.h>
#include <io.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Windows 10 can replace a file that somebody reads, if asked in this way.
bool replace_open_file(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  const std::wstring name = fs::absolute(to, ignored).native();
  const std::size_t bytes = sizeof(FILE_RENAME_INFO) + sizeof(wchar_t) * name.size();
  std::vector<std::uint64_t> memory(bytes / 8 + 1);
  auto* info = reinterpret_cast<FILE_RENAME_INFO*>(memory.data());
  constexpr DWORD replace_if_exists = 1, posix_semantics = 2, flags = replace_if_exists | posix_semantics;
  std::memcpy(info, &flags, sizeof flags);
  info->FileNameLength = static_cast<DWORD>(sizeof(wchar_t) * name.size());
  std::memcpy(info->FileName, name.data(), sizeof(wchar_t) * name.size());
  const HANDLE file =
      CreateFileW(from.c_str(), DELETE, all_may, nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file == INVALID_HANDLE_VALUE) return false;
  constexpr auto rename_info_ex = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);
  const bool done = SetFileInformationByHandle(file, rename_info_ex, info, static_cast<DWORD>(bytes)) != 0;
  CloseHandle(file);
  return done;
}

/// Whether the part of a name before its first dot is a device in every folder.
bool is_device(std::string name) {
  name = name.substr(0, name.find('.'));
  while (name.ends_with(' ')) name.pop_back();
  for (char& letter : name)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  for (const char* device : {"CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"})
    if (name == device) return true;
  return name.size() == 4 && (name.starts_with("COM") || name.starts_with("LPT")) && name[3] >= '0' && name[3] <= '9';
}

fs::path path_in(const wchar_t* variable) {
  const wchar_t* value = _wgetenv(variable);
  const fs::path path = value ? value : L"";
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

std::wstring unique_word() {
  static std::atomic<unsigned> count{0};
  const auto now = static_cast<unsigned long long>(std::chrono::system_clock::now().time_since_epoch().count());
  return std::to_wstring(GetCurrentProcessId()) + L'-' + std::to_wstring(now) + L'-' + std::to_wstring(++count);
}

std::FILE* open_stream(const fs::path& file, const char* mode) {
  return _wfopen(file.c_str(), std::wstring(mode, mode + std::strlen(mode)).c_str());
}

std::vector<std::string> names_in_folder(const fs::path& folder) {
  std::vector<std::string> names;
  WIN32_FIND_DATAW found{};
  const auto close = [](void* search) { FindClose(search); };
  const std::unique_ptr<void, decltype(close)> search(FindFirstFileW((folder / L"*").c_str(), &found), close);
  if (search.get() == INVALID_HANDLE_VALUE) return names;
  do names.push_back(fs::path(found.cFileName).string());
  while (FindNextFileW(search.get(), &found));
  return names;
}

std::size_t longest_name(const fs::path&) { return 255; }

fs::path temporary_folder() {
  std::array<wchar_t, MAX_PATH + 2> text{};
  return GetTempPathW(static_cast<DWORD>(text.size()), text.data()) > 0 ? fs::path(text.data()) : fs::path(".");
}

fs::path make_temporary_folder(const std::string& begin, int* error) {
  const fs::path folder = temporary_folder() / fs::path(begin).concat(unique_word());
  const bool made = CreateDirectoryW(folder.c_str(), nullptr) != 0;
  if (error) *error = made ? 0 : last_error_number();
  return made ? folder : fs::path();
}

void remove_file(const fs::path& file) { DeleteFileW(file.c_str()); }

/// Programs that look for viruses or make lists of what is on the disk hold new files for a moment.
int replace_file(const fs::path& from, const fs::path& to) {
  if (replace_open_file(from, to)) return 0;
  for (int attempt = 0;; ++attempt) {
    if (MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) return 0;
    const DWORD error = GetLastError();
    const bool held = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED || error == ERROR_LOCK_VIOLATION;
    if (attempt == 8 && held) return EBUSY;
    if (!held) return last_error_number(error);
    std::this_thread::sleep_for(std::chrono::milliseconds(4 << attempt));
  }
}

std::string problem_of_name(const fs::path& file) {
  for (const fs::path& part : file.relative_path()) {
    const std::string name = part.string();
    if (is_device(name)) return "\"" + name + "\" is a device of Windows, expected the name of a file";
    if (const auto bad = name.find_first_of("<>:\"|?*"); bad != name.npos)
      return std::string("found '") + name[bad] + "' in its name, which Windows does not allow there";
    if (name != "." && name != ".." && !name.empty() && (name.back() == '.' || name.back() == ' '))
      return "its name ends with a dot or a space, which Windows would leave out";
  }
  return "";
}

FileTrace trace_of(const fs::path& file) {
  const HANDLE handle = CreateFileW(file.c_str(), FILE_READ_ATTRIBUTES, all_may, nullptr, OPEN_EXISTING,
                                    FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return {};
  BY_HANDLE_FILE_INFORMATION id{};
  FILE_BASIC_INFO times{};
  GetFileInformationByHandle(handle, &id);
  GetFileInformationByHandleEx(handle, FileBasicInfo, &times, sizeof times);
  CloseHandle(handle);
  const auto joined = [](std::int64_t high, DWORD low) { return high << 32 | low; };
  return {id.dwVolumeSerialNumber, joined(id.nFileIndexHigh, id.nFileIndexLow),
          joined(id.nFileSizeHigh, id.nFileSizeLow), times.LastWriteTime.QuadPart, times.ChangeTime.QuadPart};
}

fs::path own_file() {
  HMODULE module = nullptr;
  constexpr DWORD flags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
  GetModuleHandleExW(flags, reinterpret_cast<const wchar_t*>(&own_file), &module);
  std::wstring text(32768, L'\0');
  text.resize(GetModuleFileNameW(module, text.data(), static_cast<DWORD>(text.size())));
  return text;
}

fs::path home_folder() { return path_in(L"USERPROFILE"); }
fs::path folder_of_user(const std::string&) { return path_in(L"APPDATA"); }

bool is_open_file(const fs::path&) { return false; }

/// Of a folder the mark means something else.
std::string protection_of(const fs::path& file) {
  const DWORD attributes = GetFileAttributesW(file.c_str());
  const bool folder = (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  const bool read_only = attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_READONLY) != 0;
  return read_only && !folder ? "only be read" : "";
}

bool is_kept_by_sticky_folder(const fs::path&, const fs::path&) { return false; }
int writing_error(const fs::path& file) { return OpenFile(file, OpenFor::writing).error(); }

}  // namespace tyndall

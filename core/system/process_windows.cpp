#include "core/system/process.h"

#include "core/system/processors.h"
#include "core/system/windows_api.h"

#include <fcntl.h>
#include <io.h>
#include <psapi.h>
#include <shellapi.h>
#include <shlobj.h>

#include <algorithm>
#include <chrono>
#include <clocale>

namespace tyndall {
namespace {

/// Whether Windows opened the console for the program alone, which was double-clicked.
bool has_own_console() {
  DWORD first = 0;
  return GetConsoleProcessList(&first, 1) == 1;
}

bool is_absolute(const std::string& path) { return std::filesystem::path(path).is_absolute(); }

/// A double click starts the program in its own folder, which is no place for what the user saves.
void go_to_documents() {
  wchar_t folder[MAX_PATH];
  if (SHGetFolderPathW(nullptr, CSIDL_PERSONAL, nullptr, SHGFP_TYPE_CURRENT, folder) == S_OK)
    SetCurrentDirectoryW(folder);
}

}  // namespace

void begin_process() {
  _fmode = _O_BINARY;
  for (const int stream : {0, 1, 2}) _setmode(stream, _O_BINARY);  // fails for those that are closed, as it should
  std::setlocale(LC_CTYPE, ".UTF8");                               // UCRT's; see names_windows.cpp for msvcrt's
  SetConsoleOutputCP(CP_UTF8);
  DWORD mode = 0;
  const HANDLE errors = GetStdHandle(STD_ERROR_HANDLE);
  if (GetConsoleMode(errors, &mode)) SetConsoleMode(errors, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  if (has_own_console()) ShowWindow(GetConsoleWindow(), SW_SHOWMINNOACTIVE);
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);  // no windows that wait for somebody
}

/// The C library's own arguments would be in the letters of one country, with stars replaced by names of files.
std::vector<std::string> program_arguments(int, char**) {
  int count = 0;
  wchar_t** words = CommandLineToArgvW(GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int k = 1; words && k < count; ++k) arguments.push_back(std::filesystem::path(words[k]).string());
  LocalFree(words);
  if (has_own_console() && std::all_of(arguments.begin(), arguments.end(), is_absolute)) go_to_documents();
  return arguments;
}

/// The null device is a "terminal" of the C library, too.
bool is_terminal(int descriptor) {
  DWORD mode = 0;
  return GetConsoleMode(reinterpret_cast<HANDLE>(_get_osfhandle(descriptor)), &mode) != 0;
}

bool has_smart_terminal() {
  DWORD mode = 0;
  return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0 && (mode & ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

int terminal_columns() {
  CONSOLE_SCREEN_BUFFER_INFO info{};
  if (!GetConsoleScreenBufferInfo(GetStdHandle(STD_ERROR_HANDLE), &info)) return 80;
  return info.srWindow.Right - info.srWindow.Left + 1;
}

bool has_display() { return true; }

void ask_for_large_pages(void*, std::size_t) {}  // only for accounts with a privilege

std::uint64_t limit_of(Limit) { return no_limit; }

/// What may still be committed: more than that is refused at once, not when it is touched.
std::uint64_t memory_of_machine() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return GlobalMemoryStatusEx(&status) ? status.ullAvailPageFile : no_limit;
}

std::size_t peak_memory() {
  PROCESS_MEMORY_COUNTERS counters{};
  return GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) ? counters.PeakWorkingSetSize : 0;
}

void lower_priority(int niceness) {
  SetThreadPriority(GetCurrentThread(), niceness >= 15 ? THREAD_PRIORITY_LOWEST : THREAD_PRIORITY_BELOW_NORMAL);
}

/// Windows counts processor time in steps of 16 ms, too coarse for what is measured here. Time that passes is no less.
double thread_cpu_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void* loaded_function(const char*, const char*) { return nullptr; }  // none is asked for that Windows has

}  // namespace tyndall

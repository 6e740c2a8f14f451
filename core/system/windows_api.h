#pragma once
/// Windows' own names, for the files *_windows.cpp of this room alone: they define words such as "near" and "far".
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <string>

namespace tyndall {

/// What others may do with a file that is open here, as on other systems.
inline constexpr DWORD all_may = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
/// The error number of POSIX that is most like an error of Windows: the last one of this thread.
int last_error_number(DWORD error = GetLastError());
/// A word that no other call of any process gives.
std::wstring unique_word();

}  // namespace tyndall

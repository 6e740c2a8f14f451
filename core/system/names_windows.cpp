#include "core/system/windows_api.h"

#include <algorithm>
#include <cwchar>
#include <utility>

// Names of files are UTF-8 everywhere in the program, and libstdc++ gives them so in path::string(); but what it makes
// a path of goes through mbrtowc(), whose version in msvcrt.dll knows no UTF-8. These take its place, and that of its
// neighbours in the C library's object, which would bring it along. (UCRT's are told by begin_process().) A byte that
// is no letter becomes U+FFFD, so that a damaged name is one of no file and no error.
#ifndef _UCRT

/// A letter beyond the basic plane becomes two: the first takes three bytes and leaves the second one in the state.
extern "C" std::size_t mbrtowc(wchar_t* to, const char* from, std::size_t size, std::mbstate_t* state) {
  if (!from) return 0;
  if (size == 0) return static_cast<std::size_t>(-2);
  wchar_t letters[2] = {L'\ufffd'};
  std::size_t bytes = 1;
  if (state && *state != 0) {
    letters[0] = static_cast<wchar_t>(std::exchange(*state, 0));
  } else {
    int made = 0;
    for (int length = 1; made == 0 && length <= static_cast<int>(std::min<std::size_t>(size, 4)); ++length) {
      made = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, from, length, letters, 2);
      if (made > 0) bytes = static_cast<std::size_t>(length);
    }
    if (made == 0) letters[0] = L'\ufffd';
    if (made == 2 && state) *state = static_cast<std::mbstate_t>(letters[1]), bytes = 3;
  }
  if (to) *to = letters[0];
  return letters[0] == 0 ? 0 : bytes;
}

extern "C" std::size_t mbrlen(const char* from, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own{};
  return mbrtowc(nullptr, from, size, state ? state : &own);
}

extern "C" std::size_t mbsrtowcs(wchar_t* to, const char** from, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own{};
  std::size_t count = 0;
  for (const char* at = *from; !to || count < size; ++count) {
    wchar_t letter = 0;
    const std::size_t got = mbrtowc(&letter, at, std::char_traits<char>::length(at) + 1, state ? state : &own);
    if (to) to[count] = letter, *from = got == 0 ? nullptr : at + got;
    if (got == 0) return count;
    at += got;
  }
  return count;
}

#endif

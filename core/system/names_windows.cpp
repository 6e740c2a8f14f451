#include "core/system/windows_api.h"

#include <cwchar>

namespace tyndall {

std::string utf8_of(const wchar_t* text) { return std::filesystem::path(text).string(); }

}  // namespace tyndall

// Names of files are UTF-8 everywhere in the program, and libstdc++ gives them so in path::string(); but what it makes
// a path of goes through mbrtowc(), whose version in msvcrt.dll knows no UTF-8. These take its place, and that of its
// neighbours in the C library's object, which would bring it along. (UCRT's are told by begin_process().) A byte that
// is no letter becomes U+FFFD, so that a damaged name is one of no file and no error.
#ifndef _UCRT

namespace {

constexpr auto not_whole = static_cast<std::size_t>(-2);

std::size_t bad_letter(wchar_t* to) {
  if (to) *to = L'\ufffd';
  return 1;
}

/// Bytes of the letter that this one begins; 0: none begins so.
std::size_t length_of(unsigned first) {
  if (first < 0x80) return 1;
  if (first < 0xc2 || first > 0xf4) return 0;
  return first < 0xe0 ? 2 : (first < 0xf0 ? 3 : 4);
}

}  // namespace

/// A letter beyond the basic plane becomes two: the first takes three bytes and leaves the second one in the state.
extern "C" std::size_t mbrtowc(wchar_t* to, const char* from, std::size_t size, std::mbstate_t* state) {
  if (!from) return 0;
  if (size == 0) return not_whole;
  if (state && *state != 0) {
    if (to) *to = static_cast<wchar_t>(*state);
    *state = 0;
    return 1;
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(from);
  const std::size_t length = length_of(bytes[0]);
  if (length == 0 || size < length) return bad_letter(to);
  unsigned code = length == 1 ? bytes[0] : bytes[0] & (0x7fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((bytes[k] & 0xc0) != 0x80) return bad_letter(to);
    code = code << 6 | (bytes[k] & 0x3fu);
  }
  if (length == 4 && state) {
    code -= 0x10000;
    if (to) *to = static_cast<wchar_t>(0xd800 + (code >> 10));
    *state = static_cast<std::mbstate_t>(0xdc00 + (code & 0x3ff));
    return 3;
  }
  if (to) *to = static_cast<wchar_t>(code);
  return code == 0 ? 0 : length;
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

#pragma once
#include <cstdint>
#include <cstdio>
#include <string>

/// Short names for long texts.
namespace tyndall::test {

/// 64-bit FNV-1a of a text, as 16 hexadecimal digits: names kept files after the scene that made them.
inline std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace tyndall::test

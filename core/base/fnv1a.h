#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace tyndall {

/// 64-bit FNV-1a of some bytes; `before`: of those that stand before them, to hash in parts. Not for texts that an
/// adversary made. Fowler, Noll, Vo: The FNV Non-Cryptographic Hash Algorithm.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u) {
  std::uint64_t hash = before;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// A hash as files and figures say it: 16 hexadecimal digits.
inline std::string hash_text(std::uint64_t hash) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4) text[i] = digits[hash & 15];
  return text;
}

}  // namespace tyndall

#pragma once
#include <cstdint>
#include <string_view>

namespace tyndall {

/// 64-bit FNV-1a of some bytes; `before`: of those that stand before them, to hash in parts. Not for texts that an
/// adversary made. Fowler, Noll, Vo: The FNV Non-Cryptographic Hash Algorithm.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u) {
  std::uint64_t hash = before;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace tyndall

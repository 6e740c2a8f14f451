#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// Hashes of texts and of data.
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

/// A quick checksum of large data: films, and the pixels of textures. Mixes in 8 bytes at a time. Each step is
/// invertible, so that films that differ in one word always get different sums. Four sums in turn, so that the
/// processor can start the next multiplication before the last one is done.
class Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const char*>(data);
    for (; size >= 32; bytes += 32, size -= 32) {
      std::uint64_t words[4];
      std::memcpy(words, bytes, sizeof words);
      for (int i = 0; i < 4; ++i) mix(sums_[i], words[i]);
    }
    for (; size > 0; ++bytes, --size) mix(sums_[0], static_cast<unsigned char>(*bytes));
  }
  template <class Number>
  void add_number(Number number) {
    mix(sums_[1], static_cast<std::uint64_t>(number));
  }
  std::uint64_t value() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t part : sums_) mix(sum, part);
    return sum;
  }

 private:
  static void mix(std::uint64_t& sum, std::uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;  // odd, so that the step is invertible
    sum ^= sum >> 29;
  }

  std::uint64_t sums_[4] = {1, 2, 3, 4};
};

}  // namespace tyndall

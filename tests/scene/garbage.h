#pragma once
#include "core/scene/load.h"

#include <algorithm>
#include <random>
#include <string>

/// Scene files with random damage.
namespace tyndall::test {

/// Pieces that change what a file means more often than a random byte does.
inline constexpr const char* pieces[] = {"{",
                                         "}",
                                         "[",
                                         "]",
                                         ",",
                                         ":",
                                         "\"",
                                         "null",
                                         "true",
                                         "-",
                                         "0",
                                         "1e999",
                                         "1e-999",
                                         "-1e38",
                                         "4294967296",
                                         "\\u0000",
                                         "\\ud800",
                                         "\xff",
                                         "//",
                                         "/*",
                                         "*/",
                                         "\n",
                                         "\"type\"",
                                         "\"name\"",
                                         "\"sphere\"",
                                         "\"material\"",
                                         "1e308",
                                         "[[[[[[[[",
                                         "]]]]]]]]",
                                         "\"objects\": [",
                                         "{\"type\":\"group\",\"objects\":["};

inline void mutate(std::string& text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n ? random() % n : 0; };
  const std::size_t at = below(text.size()), length = below(40);
  switch (below(6)) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, pieces[below(std::size(pieces))]);
      break;
    case 3:
      text.insert(at, text.substr(below(text.size()), length));
      break;
    case 4:
      text.replace(at, below(6), pieces[below(std::size(pieces))]);
      break;
    default:
      text.resize(at + 1);
  }
}

/// One to three changes.
inline std::string damaged(std::string text, std::mt19937& random) {
  for (auto k = 1 + random() % 3; k > 0 && !text.empty(); --k) mutate(text, random);
  return text;
}

/// Whether a message is one line that says what was found and what is expected.
inline bool is_clear(const std::string& what) {
  return what.starts_with("damaged.json: ") && what.find(": found ") != what.npos &&
         what.find(", expected ") != what.npos && what.size() < 1500 &&
         std::none_of(what.begin(), what.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace tyndall::test

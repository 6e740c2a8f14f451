#pragma once
// What the program uses of C++20's library and Debian's emscripten lacks: its libc++ is LLVM 13's. Included before all
// files of the build for browsers.
#include <__config>
#if _LIBCPP_VERSION < 14000
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <utility>
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
/// The fewest digits that are read back as the same number.
inline to_chars_result to_chars(char* begin, char* end, double value, chars_format format) {
  char text[400];
  int digits = 0;
  for (; digits < 17; ++digits) {
    snprintf(text, sizeof text, "%.*e", digits, value);
    if (strtod(text, nullptr) == value) break;
  }
  if (format == chars_format::fixed)
    snprintf(text, sizeof text, "%.*f", max(0, digits - atoi(strchr(text, 'e') + 1)), value);
  const auto size = static_cast<ptrdiff_t>(strlen(text));
  return size > end - begin ? to_chars_result{end, errc::value_too_large}
                            : to_chars_result{copy(text, text + size, begin), errc()};
}
namespace ranges {
template <class Range, class Value, class Part = std::identity>
auto find(Range&& range, const Value& value, Part part = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](const auto& element) { return std::invoke(part, element) == value; });
}
template <class Range>
void reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
}
}  // namespace ranges
}  // namespace std
#endif

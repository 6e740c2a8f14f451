#include "app/text/name_pattern.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

/// The pattern in a name whose place ends with that letter.
NamePattern read_pattern(const std::string& text, char letter, const std::string& expected) {
  NamePattern pattern;
  const auto refuse = [&] { throw UsageError("found " + in_quotes(printable(text)) + ", expected " + expected); };
  bool found = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& part = found ? pattern.after : pattern.before;
    if (text[i] != '%') {
      part += text[i];
    } else if (i + 1 < text.size() && text[i + 1] == '%') {
      part += text[++i];
    } else {
      const std::size_t end = text.find_first_not_of("0123456789", i + 1);
      const std::string digits = text.substr(i + 1, end == text.npos ? end : end - i - 1);
      const bool plain = digits.empty() || (letter == 'd' && digits[0] == '0' && digits.size() == 2);
      if (end == text.npos || text[end] != letter || found || !plain) refuse();
      pattern.digits = digits.empty() ? 0 : digits[1] - '0';
      found = true;
      i = end;
    }
  }
  if (!found) refuse();
  return pattern;
}

}  // namespace

NamePattern read_numbered_name(const std::string& text) {
  return read_pattern(text, 'd', "a name with the frame's number in it once, as %04d: 'f/%04d.png'");
}

NamePattern read_valued_name(const std::string& text) {
  return read_pattern(text, 'v', "a name with the value in it once, as %v: 'dir/%v.exr'");
}

std::string name_for(const NamePattern& pattern, int number) {
  const std::string digits = std::to_string(number);
  const auto zeros = static_cast<std::size_t>(std::max(0, pattern.digits - static_cast<int>(digits.size())));
  return pattern.before + std::string(zeros, '0') + digits + pattern.after;
}

std::string name_for(const NamePattern& pattern, std::string value) {
  std::replace(value.begin(), value.end(), '/', '_');
  return pattern.before + value + pattern.after;
}

}  // namespace tyndall

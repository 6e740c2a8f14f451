#include "core/scene/json_syntax.h"

#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

/// "line 3, column 5" of a byte offset; columns count letters.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view row = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(row.begin(), row.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

bool is_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' ||
         c == '+' || c == '-';
}

/// Where the word, text or letter that holds the byte at `last` begins, and what follows it.
struct Span {
  std::size_t begin, end;
};
Span token_at(std::string_view text, std::size_t last) {
  Span span{last, last + 1};
  if (text[last] == '"' && last > 0) {  // the parser reads a whole string before it finds that it is misplaced
    const std::size_t opening = text.rfind('"', last - 1);
    if (opening != text.npos && text.substr(opening, last - opening).find('\n') == text.npos) span.begin = opening;
  } else if (is_word(text[last])) {
    while (span.begin > 0 && is_word(text[span.begin - 1])) --span.begin;
    while (span.end < text.size() && is_word(text[span.end])) ++span.end;
  } else {
    while (span.begin > 0 && (static_cast<unsigned char>(text[span.begin]) & 0xc0) == 0x80) --span.begin;
    while (span.end < text.size() && (static_cast<unsigned char>(text[span.end]) & 0xc0) == 0x80) ++span.end;
  }
  return span;
}

struct Phrase {
  std::string_view reason, said;
};

/// What the parser waited for.
std::string_view expected_instead(std::string_view reason) {
  constexpr Phrase phrases[] = {{"expected string literal", "a key in double quotes"},
                                {"expected ':'", "':'"},
                                {"expected ']'", "',' or ']'"},
                                {"expected '}'", "',' or '}'"},
                                {"expected end of input", "the end of the file"}};
  for (const Phrase& phrase : phrases)
    if (reason.ends_with(phrase.reason)) return phrase.said;
  return "a value: a number, a text in double quotes, a list or an object";
}

/// Faults inside a text, a number or a comment: what is found and what should be there instead.
struct Fault {
  std::string_view reason, found, expected;
};
constexpr Fault faults[] = {
    {"invalid comment", "a comment that is not closed", "*/ at its end"},
    {"missing closing quote", "a text that is not closed", "\" at its end"},
    {"control character", "a line break or control character in a text", "\" at the end of the text, or \\n"},
    {"forbidden character after backslash", "a backslash before a letter that it cannot escape",
     "\\\\ for a backslash"},
    {"surrogate", "half of a \\u pair", "both halves of it"},
    {"'\\u' must be followed by 4 hex digits", "\\u without 4 hexadecimal digits", "\\u and 4 hexadecimal digits"},
    {"zero byte", "a zero byte", "text in UTF-8"},
    {"UTF-8", "bytes that are not UTF-8", "text in UTF-8"},
    {"invalid BOM", "a broken byte order mark", "text in UTF-8"}};

}  // namespace

ParseError syntax_error(std::string_view text, std::size_t end, std::string_view reason) {
  const bool at_end = end > text.size() || text.empty();
  const std::size_t last = at_end ? text.size() : std::max<std::size_t>(end, 1) - 1;
  for (const Fault& fault : faults)
    if (reason.find(fault.reason) != reason.npos)
      return {line_and_column(text, last), std::string(fault.found), std::string(fault.expected)};
  const std::string expected(expected_instead(reason));
  if (at_end) return {line_and_column(text, last), "the end of the file", expected};
  const Span token = token_at(text, last);
  const std::string_view found = text.substr(token.begin, token.end - token.begin);
  return {line_and_column(text, token.begin), found[0] == '"' ? shortened(found, 80) : "'" + shortened(found, 80) + "'",
          expected};
}

}  // namespace tyndall

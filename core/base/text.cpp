#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace tyndall {
namespace {

void append_hex(std::string& out, std::uint32_t number, int digits) {
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789abcdef"[number >> shift & 15];
}

/// \n, \t, \r, else like \u001b. letter: below 0x10000.
void append_escaped(std::string& out, std::uint32_t letter) {
  if (letter == '\n') {
    out += "\\n";
  } else if (letter == '\t') {
    out += "\\t";
  } else if (letter == '\r') {
    out += "\\r";
  } else {
    append_hex(out += "\\u", letter, 4);
  }
}

/// The number of the letter, whose UTF-8 is the whole text.
std::uint32_t letter_of(std::string_view utf8) {
  std::uint32_t letter = static_cast<unsigned char>(utf8[0]);
  if (utf8.size() > 1) letter &= 0x7fu >> utf8.size();
  for (const char c : utf8.substr(1)) letter = letter << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return letter;
}

/// Controls (some terminals obey U+0080 … U+009F), what ends a line or turns its direction, and the two that XML
/// refuses besides (Extensible Markup Language 1.0, section 2.2).
bool is_unprintable(std::uint32_t letter) {
  const auto within = [letter](std::uint32_t first, std::uint32_t last) { return letter >= first && letter <= last; };
  return letter < 0x20 || within(0x7f, 0x9f) || within(0x2028, 0x202e) || within(0x2066, 0x2069) ||
         within(0xfffe, 0xffff);
}

/// How many bytes the UTF-8 letter at the beginning of a text has, 1 to 4; 0 if it is not UTF-8. (Unicode, table 3-7.)
std::size_t letter_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return continues(1) ? 2 : 0;
  if (first >= 0xe0 && first < 0xf0) {
    const bool too_long = first == 0xe0 && second < 0xa0, surrogate = first == 0xed && second >= 0xa0;
    return continues(1) && continues(2) && !too_long && !surrogate ? 3 : 0;
  }
  const bool too_long = first == 0xf0 && second - 0x80 < 0x10;
  const bool too_large = first > 0xf4 || (first == 0xf4 && second >= 0x90);
  return first >= 0xf0 && continues(1) && continues(2) && continues(3) && !too_long && !too_large ? 4 : 0;
}

/// How many edits turn a into b: a letter added, left out or replaced, or two neighbours swapped.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = letter_size(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty()) {
    if (out.size() >= limit) return out + "…";
    const std::size_t size = letter_size(text);
    const std::string_view letter = text.substr(0, std::max<std::size_t>(size, 1));
    if (size == 0) {
      append_hex(out += "\\x", static_cast<unsigned char>(letter[0]), 2);
    } else if (is_unprintable(letter_of(letter))) {
      append_escaped(out, letter_of(letter));
    } else {
      out += letter;
    }
    text.remove_prefix(letter.size());
  }
  return out;
}

std::size_t size_of_letters(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text.size();
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xc0) == 0x80) --limit;
  return limit;
}

std::uint32_t next_letter(std::string_view text, std::size_t& at) {
  const std::string_view rest = text.substr(at);
  const std::size_t size = letter_size(rest);
  at += std::max<std::size_t>(size, 1);
  return size == 0 ? 0xfffd : letter_of(rest.substr(0, size));
}

std::string shortened(std::string_view text, std::size_t limit) {
  const std::size_t size = size_of_letters(text, limit);
  return std::string(text.substr(0, size)) + (size < text.size() ? "…" : "");
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      append_escaped(out, static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string joined(const std::vector<std::string>& texts, std::string_view between) {
  std::string out;
  for (std::size_t i = 0; i < texts.size(); ++i) out += std::string(i ? between : "") + texts[i];
  return out;
}

std::string listed(const std::vector<std::string>& names, std::size_t maximum) {
  if (names.size() <= maximum) return joined(names);
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(maximum);
  return joined({names.begin(), end}) + " and " + std::to_string(names.size() - maximum) + " more";
}

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  if (value == 0) return std::signbit(value) ? "-0.0" : "0";
  const double size = std::abs(value);
  const auto format = size >= 1e-5 && size < 1e17 ? std::chars_format::fixed : std::chars_format::scientific;
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, format).ptr;
  return {digits.data(), end};
}

bool number_from_text(std::string_view text, double& value) {
#if defined(__cpp_lib_to_chars)
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
#else  // libc++ before 20
  const std::string copy(text);
  if (copy.empty() || copy.find_first_of("+xX \t\n\v\f\r") == 0 || copy.find_first_of("xX") != copy.npos) return false;
  char* end = nullptr;
  errno = 0;
  const double read = std::strtod(copy.c_str(), &end);
  if (errno == ERANGE || end != copy.c_str() + copy.size()) return false;
  value = read;
  return true;
#endif
}

std::string_view closest(std::string_view name, const std::vector<std::string_view>& candidates) {
  if (name.empty() || name.size() > 64) return {};
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    const std::size_t longer = std::max(name.size(), candidate.size()),
                      shorter = std::min(name.size(), candidate.size());
    if (longer - shorter >= best) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view meant = closest(name, candidates);
  return meant.empty() ? "" : " (did you mean " + in_quotes(meant) + "?)";
}

std::string one_of(const std::vector<std::string_view>& names) {
  std::vector<std::string> quoted;
  for (const std::string_view name : names) quoted.push_back(in_quotes(name));
  return (names.size() == 1 ? "" : "one of ") + joined(quoted);
}

}  // namespace tyndall

#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Text for messages and files: what is printed safely, quoted, shortened, or suggested for a misspelt name.
namespace tyndall {

/// The text as it can be printed in one line, also in XML and HTML: control characters, what ends a line or turns its
/// direction, U+FFFE and U+FFFF as \n, \u001b or \u2028; bytes that are not UTF-8 as \xff.
/// What exceeds `limit` bytes is replaced by "…".
std::string printable(std::string_view text, std::size_t limit = 300);
/// The same of any length.
inline std::string all_printable(std::string_view text) { return printable(text, std::string_view::npos); }

/// Whether the text is UTF-8 without surrogates (Unicode, table 3-7), so that JSON can hold it as it is.
bool is_utf8(std::string_view text);

/// How many of the text's first `limit` bytes are whole letters of UTF-8.
std::size_t size_of_letters(std::string_view text, std::size_t limit);

/// The text, or its first `limit` bytes (whole letters) and "…".
std::string shortened(std::string_view text, std::size_t limit);

/// A JSON string: in quotes, with ", \ and control characters escaped.
std::string in_quotes(std::string_view text);

/// The shortest decimal that reads back as the same double; "nan", "inf" and "-inf" where there is none.
std::string number_text(double value);

/// Reads the whole text as a number of decimal digits ("-1.5", "2e3"), whatever the language of the user; false, with
/// the value as it was, if it is none. Also "inf" and "nan" are numbers.
bool number_from_text(std::string_view text, double& value);

/// The candidate that a misspelt name probably means: at most a third of its letters are wrong. Empty: there is none.
std::string_view closest(std::string_view name, const std::vector<std::string_view>& candidates);

/// ` (did you mean "closest"?)`, or nothing.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);

/// `one of "a", "b", "c"`, or `"a"` alone.
std::string one_of(const std::vector<std::string_view>& names);

}  // namespace tyndall

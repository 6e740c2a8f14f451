#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Text for messages and files: what is printed safely, quoted, shortened, or suggested for a misspelt name.
namespace tyndall {

/// The text as it can be printed in one line: control characters as \n or \u001b, bytes that are not UTF-8 as \xff.
/// What exceeds `limit` bytes is replaced by "…".
std::string printable(std::string_view text, std::size_t limit = 300);

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

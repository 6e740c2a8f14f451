#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Text for messages and files: what is printed safely, quoted, shortened, or suggested for a misspelt name.
namespace tyndall {

/// Returns the text in a form that can be printed in one line, also in XML and HTML: control characters, line ends,
/// direction marks, U+FFFE and U+FFFF become \n, \u001b or \u2028; bytes that are not UTF-8 become \xff. A result above
/// `limit` bytes is cut and ends with "…".
std::string printable(std::string_view text, std::size_t limit = 300);
/// The same of any length.
inline std::string all_printable(std::string_view text) { return printable(text, std::string_view::npos); }

/// Whether the text is UTF-8 without surrogates (Unicode, table 3-7), so that JSON can hold it as it is.
bool is_utf8(std::string_view text);

/// Returns the size, at most `limit`, of the longest beginning of the text that ends with a whole UTF-8 letter.
std::size_t size_of_letters(std::string_view text, std::size_t limit);

/// The letter at a byte of a UTF-8 text, and the place of the next one; 0xfffd for a byte that belongs to none.
std::uint32_t next_letter(std::string_view text, std::size_t& at);

/// The text, or its first `limit` bytes (whole letters) and "…".
std::string shortened(std::string_view text, std::size_t limit);

/// A JSON string: in quotes, with ", \ and control characters escaped.
std::string in_quotes(std::string_view text);

/// The texts one after the other, with `between` between them.
std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ");
/// "a, b and 7 more": the first `maximum` of the names, and how many there are beside them.
std::string listed(const std::vector<std::string>& names, std::size_t maximum);

/// The text with small letters in place of the capitals A to Z.
std::string lower_case(std::string text);

/// The shortest decimal that reads back as the same double; "nan", "inf" and "-inf" where there is none.
std::string number_text(double value);

/// Reads the whole text as a decimal number ("-1.5", "2e3", "inf", "nan"), independent of the user's locale. Returns
/// false and leaves `value` unchanged if the text is not a number.
bool number_from_text(std::string_view text, double& value);

/// Returns the candidate that a misspelt name probably means (at most a third of its letters are wrong); empty if there
/// is none.
std::string_view closest(std::string_view name, const std::vector<std::string_view>& candidates);

/// ` (did you mean "closest"?)`, or nothing.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);

/// `one of "a", "b", "c"`, or `"a"` alone.
std::string one_of(const std::vector<std::string_view>& names);

}  // namespace tyndall

#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Text as other formats quote it: whatever it is, also the name of a file, these stay well-formed.
namespace tyndall {

/// As XML, so JUnit and SVG, holds it, between tags or in quotes: <, >, &, " and ' are references. What it cannot hold,
/// control characters and bytes that are not UTF-8, becomes as printable() writes it.
std::string in_xml(std::string_view text);
/// The same as HTML holds it, where > stands for itself.
std::string in_html(std::string_view text);
/// As one field of CSV: in quotes where it needs them.
std::string in_csv(const std::string& text);
/// As one word of a shell's command line, in single quotes.
std::string in_shell(std::string_view text);

/// The text of a file in assets/templates, with a text in the place of each {{name}}, in the order in which these stand
/// there. Throws IoError if the file is not there, or lacks a name.
std::string from_template(const std::string& file, const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace tyndall

#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What can be seen of C++ source text without compiling it.
namespace tyndall {

/// One #include "NAME" or <NAME>.
struct Include {
  std::size_t line_begin = 0, line_end = 0;  ///< bytes of its line in the text, without the line's end
  std::string name;
  bool quoted = true;
};
std::vector<Include> includes_of(std::string_view text);

/// The text with comments as blanks; lines stay lines.
std::string without_comments(std::string_view text);

/// Words, numbers and single signs of text without comments; strings are left out.
std::vector<std::string> tokens_of(std::string_view text);

/// What both "Hittable_List.hpp" and "../src/hittable-list.h" are called: "hittablelist".
std::string key_of(std::string_view name);

/// The name that the books give a class, by a reader's name in another style (XZRect: xz_rect); "": it is none of
/// theirs.
std::string book_class(const std::string& name);

/// Classes that the text defines, and the first class that each is derived from ("": none).
std::map<std::string, std::string> classes_of(std::string_view text);
/// Names that are defined as numbers outside of any braces: "pi" of `const double pi = 3.14;`.
std::vector<std::string> constants_of(std::string_view text);
/// What stands between quotes, on one line, without escapes.
std::vector<std::string> strings_of(std::string_view text);
/// Whether the word stands in the text as a whole.
bool has_name(std::string_view text, std::string_view word);

/// The generator of random numbers that the text uses in place of rand(): options for the compiler, see
/// tyndall/book/parts/random.h. Empty: rand(), or one whose numbers nobody can repeat.
std::vector<std::string> random_options(const std::string& text);

/// The sky that rays see in a camera.h of the fourth edition, as JSON; nothing: it cannot be told.
std::optional<std::string> sky_of(const std::string& text);

}  // namespace tyndall

#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// One thing that C++ text declares or defines outside of any braces.
struct Definition {
  std::string name;
  std::string text;           ///< as it stands, with its braces and semicolon; functions are made inline
  std::size_t line = 1;       ///< where it begins in its file
  std::string base;           ///< of a class: the first class that it is derived from; else empty
  bool is_namespace = false;  ///< all of it
};

/// The name of a using-directive in this sense.
constexpr const char* using_namespace = "using namespace";

/// What the text, which is free of comments, declares or defines at its top level: functions, types, aliases,
/// variables, macros, namespaces, names that `using` brings. Left out: operators, members defined outside of classes.
std::vector<Definition> definitions_of(std::string_view text);

/// The same of the members of a class, whose text begins with "class" or "struct".
std::vector<Definition> members_of(std::string_view text);

}  // namespace tyndall

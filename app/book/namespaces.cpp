#include "app/book/namespaces.h"

#include "app/book/source_text.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace tyndall {
namespace {

/// Functions and constants of the books' that ours have, too.
constexpr std::string_view book_functions[] = {"cross",
                                               "degrees_to_radians",
                                               "dot",
                                               "infinity",
                                               "pi",
                                               "random_double",
                                               "random_in_unit_disk",
                                               "random_in_unit_sphere",
                                               "random_int",
                                               "random_on_hemisphere",
                                               "random_unit_vector",
                                               "reflect",
                                               "refract",
                                               "unit_vector"};

}  // namespace

bool is_of_the_books(const Definition& one) {
  if (!one.is_namespace) return !book_class(one.name).empty();
  for (const auto& [name, base] : classes_of(one.text))
    if (!book_class(name).empty()) return true;
  return false;
}

std::string namespace_of_ours(const Definition& one) {
  std::string text = one.text.substr(0, one.text.find('{')) + "{\n";  // also of "namespace a::b"
  for (const Definition& member : members_of(one.text)) {
    const std::string ours = book_class(member.name);
    const bool is_function =
        std::find(std::begin(book_functions), std::end(book_functions), member.name) != std::end(book_functions);
    if (member.is_namespace && is_of_the_books(member)) text += namespace_of_ours(member);
    if (!ours.empty() && ours != member.name) text += "using " + member.name + " = ::" + ours + ";\n";
    if (ours == member.name || is_function) text += "using ::" + member.name + ";\n";
  }
  return text + "}\n";
}

}  // namespace tyndall

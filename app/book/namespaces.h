#pragma once
#include "app/book/definitions.h"

#include <string>

namespace tyndall {

/// Whether it defines a class of the books', or is a namespace that does.
bool is_of_the_books(const Definition& one);

/// Text that defines the reader's namespace `one`, in which the books' names are, with ours: "namespace studio { using
/// Sphere = ::sphere; using ::dot; }".
std::string namespace_of_ours(const Definition& one);

}  // namespace tyndall

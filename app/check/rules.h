#pragma once
#include "app/check/book_paths.h"
#include "app/check/reading.h"

#include <functional>
#include <string>
#include <vector>

/// What programs of the books do otherwise: by their edition, and by usual mistakes.
namespace tyndall {

/// One thing that a program may do otherwise.
struct Difference {
  std::string name;   ///< for scripts: "schlick-always-1"
  std::string words;  ///< a clause without subject: "glass reflects everything (…)"
  /// Changes the program; false: it has nothing that this would change.
  std::function<bool(BookProgram&)> apply;
};

/// What editions and compilers do otherwise: said, never counted as a mistake. The first of two that exclude each other
/// is the more usual one.
std::vector<Difference> usual_choices();

/// A wrong way to write the picture; it changes nothing in the program.
Difference mistake_of(const Reading& reading);
/// Paths that end after so many scattering events.
Difference shorter_paths(int max_depth);
/// Mistakes that are found by rendering the scene with each of them.
std::vector<Difference> usual_mistakes();

}  // namespace tyndall

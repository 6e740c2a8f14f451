#pragma once
#include "app/book/program_layout.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tyndall {

/// What the reader's headers have beyond the books' names: a constant, a helper function, a class. Where ours take the
/// place of such a header these are missing, and the compiler says so; then they are taken over, by name.
class OwnNames {
 public:
  explicit OwnNames(const ProgramLayout& layout) : layout_(layout) {}

  /// Changes what the compiler's errors call for; false: that is not the reader's.
  bool mend(const std::string& errors);
  /// Texts that are other than the layout has them. Shapes, materials and textures are there by name alone: Tyndall
  /// refuses them if the scene has one, and a program may define more than its scene has.
  std::map<std::string, std::string> texts() const;

 private:
  bool add(const std::string& name);
  bool add_member(const std::string& error);
  bool add_text(const char* macro, const std::string& text);
  bool is_pointer_to_material(const std::string& name) const;
  std::string alias_of_camera(const std::string& name) const;
  std::string function_of(const std::string& ours, const std::string& name) const;
  bool drop(const std::string& error);
  bool drop_body(const std::string& error);
  std::string header() const;

  const ProgramLayout& layout_;
  std::set<std::string> names_;
  std::map<std::string, std::string> aliases_;  ///< the reader's name for a class of the books
  std::set<std::string> dropped_;               ///< own headers of shapes and the like that ours cannot be mixed with
  std::set<std::string> empty_classes_;         ///< own classes that are there by name alone, as their text is wrong
  std::vector<std::string> notes_;              ///< that the program tells
  std::map<std::string, std::string> members_;  ///< of our classes, by macro: see tyndall/book/parts/random.h
};

}  // namespace tyndall

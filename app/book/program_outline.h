#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The classes and functions of a program, as far as they can be seen in its
/// preprocessed text.
namespace tyndall {

struct Parameter {
  std::string type, name;                ///< name: "", it has none
  std::vector<std::string> identifiers;  ///< those of its type
  bool names(const std::string& identifier) const;
};

struct Function {
  std::string name,
      result;  ///< result: the type that it returns; "": a constructor
  std::vector<Parameter> parameters;
  int owner = -1;  ///< the class, by its place in the outline
  bool is_virtual = false, is_static = false;
  std::string_view body;  ///< with its braces; empty: it is only declared
};

struct OutlinedClass {
  std::string name,
      space;                         ///< space: the namespaces and classes around it, "a::b"
  std::vector<std::string> bases;    ///< without their namespaces
  std::vector<std::string> members;  ///< names of what each of its objects holds
  bool can_be_named = true;          ///< it is no template, and in none
  std::string qualified() const { return "::" + (space.empty() ? "" : space + "::") + name; }
};

struct ProgramOutline {
  std::vector<OutlinedClass> classes;
  std::vector<Function> functions;
  std::vector<std::string_view> heads;       ///< strings that begin a picture in the P3 format, behind <<
  std::vector<std::filesystem::path> files;  ///< of the reader's, the first ones first

  /// Whether the class of that name is the root or derived from it.
  bool is_derived(const std::string& name, const std::string& root) const;
};

/// Lower case, without underscores: "Hittable_List" and "hittableList" are
/// "hittablelist".
std::string key_of(const std::string& name);

/// text: what a compiler's -E makes, which must outlive the outline. Files
/// below one of `ours` are left out, as are those of the system.
ProgramOutline outline_of(const std::string& text, const std::vector<std::filesystem::path>& ours);

}  // namespace tyndall

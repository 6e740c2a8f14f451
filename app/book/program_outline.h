#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The classes and functions of a program, as far as they can be seen in its preprocessed text.
namespace tyndall {

struct Parameter {
  std::vector<std::string> type, identifiers;  ///< the tokens of its type; those of them that are names
  std::string name;                            ///< "": it has none
  bool has(std::string_view token) const { return std::find(type.begin(), type.end(), token) != type.end(); }
};

struct Function {
  std::string name, owner, result;  ///< owner: the class, "": none; result: the type that it returns; "": a constructor
  std::vector<Parameter> parameters;
  bool is_virtual = false, is_static = false;
  std::string_view body;  ///< with its braces; empty: it is only declared
};

struct OutlinedClass {
  std::string name, qualified;       ///< qualified: with the namespaces and classes around it, "::a::b::name"
  std::vector<std::string> bases;    ///< without their namespaces
  std::vector<std::string> members;  ///< names of what each of its objects holds
  bool can_be_named = true;          ///< it is no template, and in none
};

struct ProgramOutline {
  std::vector<OutlinedClass> classes;
  std::vector<Function> functions;
  std::vector<std::filesystem::path> files;  ///< of the reader's, the first ones first

  /// The class of that name; null: it is none of the reader's.
  const OutlinedClass* class_named(const std::string& name) const;
  /// Whether the class of that name is the root or derived from it.
  bool is_derived(const std::string& name, const std::string& root) const;
};

inline bool is_one_of(std::string_view word, std::initializer_list<std::string_view> all) {
  return std::find(all.begin(), all.end(), word) != all.end();
}
/// Lower case, without underscores: "Hittable_List" and "hittableList" are
/// "hittablelist".
std::string key_of(const std::string& name);

/// text: what a compiler's -E makes, which must outlive the outline. Files
/// below one of `ours` are left out, as are those of the system.
ProgramOutline outline_of(const std::string& text, const std::vector<std::filesystem::path>& ours);

/// A program with calls into tyndall/book/hooks.h in its functions, and behind it what tells our headers the names of
/// his classes. Nothing else of it changes.
struct InsertedCalls {
  std::string text;
  std::string problem;  ///< why there is nothing to be asked; "": there is
};

/// text: preprocessed, its outline; see there. reads_world: whether the reader's world is looked at, which needs to
/// know more of his classes than samples do.
InsertedCalls insert_calls(const std::string& text, const ProgramOutline& outline, bool reads_world);

}  // namespace tyndall

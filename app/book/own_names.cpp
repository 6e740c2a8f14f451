#include "app/book/own_names.h"

#include "app/book/source_text.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace tyndall {
namespace {

/// Whether a message of GCC's or Clang's is about a name that is declared nowhere.
bool is_about_missing_name(const std::string& message) {
  for (const char* words :
       {"was not declared", "has not been declared", "does not name a type", "is not a class",
        "there are no arguments to", "undeclared identifier", "unknown type name", "no template named",
        "expected class name", "expected class-name", "expected type-specifier"})
    if (message.find(words) != std::string::npos) return true;
  return false;
}

/// The class of the books that the reader's is derived from, by way of other classes of the reader's; else empty.
std::string book_base(const ProgramLayout& layout, std::string name) {
  for (int step = 0; step < 10; ++step) {
    const auto own = layout.own_classes.find(name);
    if (own == layout.own_classes.end()) return name;
    name = own->second.base;
  }
  return "";
}

}  // namespace

bool OwnNames::mend(const std::string& errors) {
  bool mended = false;
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error: ") == std::string::npos) continue;
    if (is_about_missing_name(line)) mended |= add(quoted_name(line));
    mended |= drop(line);
  }
  return mended;
}

bool OwnNames::add(const std::string& name) {
  if (const std::string ours = book_class(name); !ours.empty() && ours != name)
    return aliases_.emplace(name, ours).second;
  const auto has = [&](const OwnHeader& header) {
    return std::any_of(header.definitions.begin(), header.definitions.end(),
                       [&](const Definition& one) { return one.name == name; });
  };
  bool known = std::any_of(layout_.replaced.begin(), layout_.replaced.end(), has);
  for (const std::string& dropped : dropped_) known = known || has(layout_.own_headers.at(dropped));
  if (!known && name != using_namespace) return add(using_namespace);
  return known && names_.insert(name).second;
}

/// Leaves out the header that the error is in, if it defines a shape, a material or a texture.
bool OwnNames::drop(const std::string& line) {
  for (const auto& [name, header] : layout_.own_headers) {
    if (line.rfind(header.shown + ":", 0) != 0) continue;
    for (const Definition& one : header.definitions)
      if (!one.base.empty() && kind_of_base(book_base(layout_, one.name))) return dropped_.insert(name).second;
  }
  return false;
}

std::map<std::string, std::string> OwnNames::texts() const {
  std::map<std::string, std::string> texts{{own_names, header()}};
  for (const std::string& dropped : dropped_)
    texts[dropped] = "#pragma once\n#include \"" + std::string(our_headers) + "\"\n";
  return texts;
}

std::string OwnNames::header() const {
  std::string text = "#pragma once\n";
  for (const auto& [name, ours] : aliases_) text += "using " + name + " = " + ours + ";\n";
  std::vector<const OwnHeader*> headers;
  for (const OwnHeader& header : layout_.replaced) headers.push_back(&header);
  for (const std::string& dropped : dropped_) headers.push_back(&layout_.own_headers.at(dropped));
  std::set<std::string> stubs;
  for (const OwnHeader* header : headers)
    for (const Definition& definition : header->definitions) {
      const std::string& name = definition.name;
      if (!names_.contains(name)) continue;
      const std::string base = definition.base.empty() ? "" : book_base(layout_, name);
      const char* ours = kind_of_base(base);
      const bool by_name_alone = ours && !key_of(base).ends_with("list");
      if (by_name_alone && stubs.insert(name).second)
        text += "struct " + name + " : " + ours + " { template <class... T> " + name + "(const T&...) {} };\n";
      if (!by_name_alone)
        text += "#line " + std::to_string(definition.line) + " \"" + escaped(header->shown) + "\"\n" + definition.text +
                "\n";
    }
  return text;
}

}  // namespace tyndall

#include "app/book/own_names.h"

#include "app/book/camera_constructor.h"
#include "app/book/source_text.h"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <string_view>

namespace tyndall {
namespace {

constexpr const char* vec3_members = "TYNDALL_BOOK_VEC3_MEMBERS";

/// Whether a message of GCC's or Clang's is about a name that is declared nowhere.
bool is_about_missing_name(const std::string& message) {
  for (const char* phrase :
       {"was not declared", "has not been declared", "does not name a type", "is not a class",
        "there are no arguments to", "undeclared identifier", "unknown type name", "no template named",
        "expected class name", "expected class-name", "expected type-specifier"})
    if (message.find(phrase) != std::string::npos) return true;
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

/// Whether a member of a camera, by its name, decides how the picture is computed or written, and not what it shows.
bool is_without_effect(const std::string& name) {
  static const std::regex effect("sample|depth|width|height|size|bounce|scale"),
      no_effect("thread|openmp|omp|parallel|progress|verbose|log|gpu|cuda|bvh|file|path|output|tile");
  const std::string key = key_of(name);
  return std::regex_search(key, no_effect) && !std::regex_search(key, effect);
}

/// Whether a member function of a camera, by its name, prepares it for what its render() does anyway.
bool is_preparation(const std::string& name) {
  static const std::regex usual("(?:init|initiali[sz]e|setup|update|prepare)(?:camera)?");
  return std::regex_match(key_of(name), usual);
}

/// Whether a member function of a list, by its name, adds an object.
bool is_adding(const std::string& name) {
  static const std::regex usual("(?:add|append|insert|push|pushback)(?:object|hittable|shape)?");
  return std::regex_match(key_of(name), usual);
}

}  // namespace

bool OwnNames::mend(const std::string& errors) {
  bool mended = false;
  std::istringstream lines(errors);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error: ") == std::string::npos) continue;
    if (is_about_missing_name(line))
      mended |= add(quoted_name(line)) || add_text(vec3_members, function_of("vec3", quoted_name(line)));
    mended |= add_member(line) || drop(line) || drop_body(line);
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

/// Gives a class of ours a member that only the reader's has: functions of vectors and lists as they stand, and of
/// cameras what does not change the picture.
bool OwnNames::add_member(const std::string& error) {
  static const std::regex gcc(R"('([^']*)'(?: \{aka '([^']*)'\})? has no member named '(\w+)')"),
      clang(R"(no member named '(\w+)' in '([^']*)')"), of_class(R"('(\w+)' is not a member of '([^']*)')");
  std::smatch found;
  std::string type, name;
  if (std::regex_search(error, found, gcc))
    type = found[2].length() > 0 ? found[2] : found[1], name = found[3];
  else if (std::regex_search(error, found, clang) || std::regex_search(error, found, of_class))
    type = found[2], name = found[1];
  std::string ours = book_class(type.substr(type.find_last_of(" :") + 1));
  if (ours == "color" || ours == "point3") ours = "vec3";
  if (ours == "camera" && is_without_effect(name))
    return add_text("TYNDALL_BOOK_CAMERA_MEMBERS", "tyndall_book::ignored " + name + ";");
  if (ours == "camera" && is_preparation(name))
    return add_text("TYNDALL_BOOK_CAMERA_MEMBERS", "void " + name + "() const {}");
  if (ours == "camera") {
    const std::string alias = alias_of_camera(name);
    if (!add_text("TYNDALL_BOOK_CAMERA_MEMBERS", alias)) return false;
    const std::size_t value = alias.find('=') + 2;
    notes_.push_back("the camera's " + name + " is taken for " + alias.substr(value, alias.size() - value - 1));
    return true;
  }
  if (ours == "hit_record" && is_pointer_to_material(name))
    return add_text("TYNDALL_BOOK_HIT_MEMBERS", "tyndall_book::ref<::material> " + name + ";") &&
           add_text("TYNDALL_BOOK_HIT_MATERIALS", "record." + name + " = &seen;");
  if (ours == "vec3") return add_text(vec3_members, function_of(ours, name));
  if (ours == "hittable_list" && is_adding(name))
    return add_text("TYNDALL_BOOK_HITTABLE_LIST_MEMBERS",
                    "void " + name + "(tyndall_book::ref<hittable> object) { add(object); }");
  if (ours == "hittable_list") return add_text("TYNDALL_BOOK_HITTABLE_LIST_MEMBERS", function_of(ours, name));
  return false;
}

bool OwnNames::add_text(const char* macro, const std::string& text) {
  if (text.empty() || members_[macro].find(text) != std::string::npos) return false;
  members_[macro] += " " + text;
  return true;
}

std::string OwnNames::alias_of_camera(const std::string& name) const {
  for (const OwnHeader& header : layout_.replaced)
    for (const Definition& one : header.book_classes) {
      const std::string alias = book_class(one.name) == "camera" ? camera_alias(one.text, name) : "";
      if (!alias.empty()) return alias;  // "class camera;" alone has none
    }
  return "";
}

/// Whether the reader's hit_record has a member of that name that points to a material.
bool OwnNames::is_pointer_to_material(const std::string& name) const {
  const std::regex declared(R"([Mm]aterial\s*(?:>\s*|\*\s*))" + name + R"(\b)");
  for (const OwnHeader& header : layout_.replaced)
    for (const Definition& one : header.book_classes)
      if (book_class(one.name) == "hit_record" && std::regex_search(one.text, declared)) return true;
  return false;
}

/// The text of the functions of that name in the reader's class in place of one of ours, on one line; "": none.
std::string OwnNames::function_of(const std::string& ours, const std::string& name) const {
  std::string text;
  const auto add_from = [&](const Definition& one) {
    for (const Definition& member : members_of(one.text))
      if (member.name == name && member.text.find('{') != std::string::npos &&  // no prototype
          member.text.find_first_of("#\"") == std::string::npos)
        text += member.text;
  };
  for (const OwnHeader& header : layout_.replaced) {
    for (const Definition& one : header.book_classes)
      if (book_class(one.name) == ours) add_from(one);
    for (const Definition& one : header.definitions)  // a vector that is called otherwise
      if (ours == "vec3" && one.base.empty() && key_of(one.name).starts_with("vec")) add_from(one);
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

/// Leaves only the name of a class that has been taken over, if the error is in its text.
bool OwnNames::drop_body(const std::string& error) {
  for (const OwnHeader& header : layout_.replaced) {
    if (error.rfind(header.shown + ":", 0) != 0) continue;
    const auto line = static_cast<std::size_t>(std::strtoul(error.c_str() + header.shown.size() + 1, nullptr, 10));
    for (const Definition& one : header.definitions) {
      const auto last = one.line + static_cast<std::size_t>(std::count(one.text.begin(), one.text.end(), '\n'));
      const bool is_in = names_.contains(one.name) && one.line <= line && line <= last;
      if (is_in && !one.base.empty() && kind_of_book_class(book_base(layout_, one.name)))
        return empty_classes_.insert(one.name).second;
    }
  }
  return false;
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
  for (const auto& [macro, text] : members_) texts[our_headers] += "#define " + macro + text + "\n";
  if (!members_.empty()) texts[our_headers] += layout_.texts.at(our_headers);
  for (const std::string& dropped : dropped_)
    texts[dropped] = "#pragma once\n#include \"" + std::string(our_headers) + "\"\n";
  return texts;
}

std::string OwnNames::header() const {
  std::string text = "#pragma once\n";
  for (std::size_t k = 0; k < notes_.size(); ++k)
    text += "static const bool tyndall_told_" + std::to_string(k) + " = (tyndall_book::note(\"" + notes_[k] +
            "\"), true);\n";
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
      const bool is_empty = empty_classes_.contains(name);
      const char* ours = is_empty ? kind_of_book_class(base) : kind_of_base(base);
      const bool by_name_alone = ours && (is_empty || !key_of(base).ends_with("list"));
      if (by_name_alone && stubs.insert(name).second)
        text += "struct " + name + " : " + ours + " { template <class... T> " + name + "(const T&...) {} };\n";
      if (!by_name_alone)
        text += "#line " + std::to_string(definition.line) + " \"" + escaped(header->shown) + "\"\n" + definition.text +
                "\n";
    }
  return text;
}

}  // namespace tyndall

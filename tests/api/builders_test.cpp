// The library's structs of materials, textures and objects, made from the lists of fields that reading and writing use:
// core/api/tyndall/builders.h is this text. Write it anew with
//
//   TYNDALL_WRITE_BUILDERS=1 build/release/tests/core_tests -tc='builders*'
#include "core/base/choice.h"
#include "core/base/text.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"
#include "core/system/process.h"
#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cctype>
#include <fstream>
#include <type_traits>
#include <utility>
#include <vector>

namespace tyndall::test::builders_test {
namespace {

std::string capital(std::string word) {
  word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
  return word;
}

/// The type of a member, and its value where nothing else is said.
std::string declared(const char* name, double value) { return fmt::format("double {} = {}", name, number_text(value)); }
std::string declared(const char* name, const Vec3d& v) {
  return fmt::format("Vec3 {}{{{}, {}, {}}}", name, number_text(v.x), number_text(v.y), number_text(v.z));
}
std::string declared(const char* name, const std::optional<Vec3d>&) {
  return fmt::format("std::optional<Vec3> {}{{}}", name);
}
template <NamedEnum E>
std::string declared(const char* name, E value) {
  return fmt::format("std::string {} = \"{}\"", name, name_of(value));
}

/// The choices of an enum, for the comment.
template <class T>
std::string choices(const T*) {
  std::string words;
  if constexpr (NamedEnum<T>)
    for (const std::string_view name : names_of<T>()) words += (words.empty() ? ": " : ", ") + std::string(name);
  return words;
}

/// A struct of the header, member by member.
class Struct {
 public:
  Struct(const char* type, const std::string& about) : type_(type), about_(about) {}

  void add(const std::string& declaration, const std::string& name, const std::string& help) {
    members_ += fmt::format("  {};{}\n", declaration, help.empty() ? "" : "  ///< " + help);
    entries_.push_back(fmt::format("(\"{0}\", {0})", name));
  }
  /// The fields that a scene file must give, or the others.
  template <class Owner>
  void add_fields(bool required) {
    const Owner owner{};
    for_each_field(fields_of<Owner>(), [&]<class T>(const Field<Owner, T>& field) {
      if (field.required != required) return;
      const std::string unit = *field.unit ? fmt::format(" ({})", field.unit) : "";
      add(declared(field.name, owner.*field.value), field.name,
          field.help + unit + choices(static_cast<const T*>(nullptr)));
    });
  }
  void add_colour(const char* name) {
    if (name) add(fmt::format("Colour {}{{}}", name), name, "linear, or a texture's name");
  }
  void add_placing() {
    add("std::string name{}", "name", "for messages; may stay empty");
    add("Transform transform{}", "transform", "");
  }
  /// list: where a scene keeps such things by name, as a JSON pointer; null: nowhere.
  std::string text(const char* list) const {
    return fmt::format("/// {}\nstruct {} {{\n{}{}  std::string json() const {{{}}}\n}};\n\n", about_, capital(type_),
                       list ? fmt::format("  static constexpr const char* list = \"{}\";\n", list) : "", members_,
                       body());
  }

 private:
  /// Of the function that writes the members: in the line of its name if that leaves it at most 120 columns wide.
  std::string body() const {
    std::string lines, line = fmt::format("return detail::Members(\"{}\")", type_);
    for (const std::string& entry : entries_) {
      if (line.size() + entry.size() > 108) lines += "\n    " + std::exchange(line, "    ");
      line += entry;
    }
    line += ".text();";
    return lines.empty() && line.size() < 90 ? " " + line + " " : lines + "\n    " + line + "\n  ";
  }

  std::string type_, about_, members_;
  std::vector<std::string> entries_;
};

template <class... Kinds>
std::string materials(const std::variant<Kinds...>*) {
  const auto one = []<class Kind>(const Kind*) {
    Struct out(Kind::type, Kind::about);
    out.add_colour(Kind::colour_name);
    out.add_fields<Kind>(true), out.add_fields<Kind>(false);
    return out.text("/materials/");
  };
  return (one(static_cast<const Kinds*>(nullptr)) + ...);
}

template <class... Kinds>
std::string textures(const std::variant<Kinds...>*) {
  const auto one = []<class Kind>(const Kind*) {
    Struct out(Kind::type, Kind::about);
    if constexpr (std::is_same_v<Kind, Image>)
      out.add("std::string file{}", "file", "a picture, relative to the scene's folder");
    else
      out.add_fields<Kind>(true), out.add_fields<Kind>(false);
    return out.text("/textures/");
  };
  return (one(static_cast<const Kinds*>(nullptr)) + ...);
}

template <class... Shapes>
std::string shapes(const std::variant<Shapes...>*) {
  const auto one = []<class Shape>(const Shape*) {
    Struct out(Shape::type, Shape::about);
    out.add_fields<Shape>(true);
    out.add("std::string material{}", "material", "a material's name; empty for the boundary of a medium");
    out.add_fields<Shape>(false);
    out.add_placing();
    return out.text(nullptr);
  };
  return (one(static_cast<const Shapes*>(nullptr)) + ...);
}

template <class... Shapes>
std::string names(const std::variant<Shapes...>*) {
  std::string text;
  ((text += (text.empty() ? "" : ", ") + capital(Shapes::type)), ...);
  return text;
}

std::string medium() {
  Struct out(Medium<>::type, Medium<>::about);
  out.add("std::variant<" + names(static_cast<decltype(Volume::boundary)*>(nullptr)) + "> boundary{}", "boundary",
          "without a material");
  out.add_fields<Medium<>>(true);
  out.add("Colour albedo{1, 1, 1}", "albedo", "scattered fraction, linear, or a texture's name");
  out.add_fields<Medium<>>(false);
  out.add_placing();
  return out.text(nullptr);
}

std::string builders_text() {
  return "#pragma once\n"
         "// The materials, textures and objects of scenes, as structs. Made from the lists of fields in core by a "
         "test;\n"
         "// ranges are those of scene files, and are checked when a thing is added to a scene.\n"
         "// clang-format off\n"
         "#include <tyndall/values.h>\n\n"
         "namespace tyndall {\ninline namespace v0 {\n\n" +
         materials(static_cast<decltype(Material::kind)*>(nullptr)) +
         textures(static_cast<decltype(Texture::kind)*>(nullptr)) +
         shapes(static_cast<decltype(Solid3d::shape)*>(nullptr)) + medium() +
         "}  // namespace v0\n}  // namespace tyndall\n";
}

}  // namespace

TEST_CASE("builders: the library's structs are what the lists of fields say") {
  const std::filesystem::path file = tests_folder().parent_path() / "core/api/tyndall/builders.h";
  const std::string made = builders_text();
  if (is_set("TYNDALL_WRITE_BUILDERS")) std::ofstream(file, std::ios::binary) << made;
  CHECK_MESSAGE(test::read_text(file) == made, "tests/api/builders_test.cpp says how to write it anew");
}

}  // namespace tyndall::test::builders_test

#include "app/book/definitions.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

/// The names, each with a blank.
std::string names_in(const std::string& text) {
  std::string names;
  for (const Definition& one : definitions_of(text)) names += one.name + " ";
  return names;
}

}  // namespace

TEST_CASE("definitions: functions, variables, types, macros, namespaces") {
  CHECK(names_in("double half(double x) { if (x < 0) { return 0; } return x / 2; }\nint twice(int x = 3);\n") ==
        "half twice ");
  CHECK(
      names_in("const double e = 2.7; static const color black(0, 0, 0); color sky{1, 1, 1}; int table[] = {1, 2};") ==
      "e black sky table ");
  CHECK(names_in("using Scalar = double; using std::sqrt; using namespace std; typedef float real; enum class Axis { "
                 "x, y }; struct pair { int a; };") == "Scalar sqrt using namespace real Axis pair ");
  CHECK(names_in("#define INFINITE 1e9\n#define IN\n#pragma once\n#define MAX(a, b) \\\n (a)\nint x;") ==
        "INFINITE IN MAX x ");
  CHECK(names_in("namespace util { int f(); } namespace { int g; }") == "util ");
  CHECK(names_in("template <class T, class U> T mix(T a, U b) { return a; }") == "mix ");
  CHECK(names_in("auto square = [](double x) { return x * x; }; int after;") == "square after ");
}

TEST_CASE("definitions: operators and members of classes have no name of their own") {
  CHECK(names_in("extern int x; friend class y; static_assert(true);") == "");
  CHECK(names_in("vec3 operator-(vec3 v) { return v; } bool operator==(vec3 a, vec3 b) { return true; } int after;") ==
        "after ");
  CHECK(names_in("double vec3::length() const { return 0; } vec3::~vec3() { }") == "");
  CHECK(names_in("} int x") == "");
  CHECK(names_in("") == "");
}

TEST_CASE("members: those of a class, by their names") {
  const auto found = members_of(
      "class vec3 { public: vec3() : e{0, 0} {} double norm() const { return 0; }\n private :\n double e[3]; };");
  std::string names;
  for (const Definition& one : found) names += one.name + " ";
  CHECK(names.find("norm e ") != std::string::npos);
  CHECK(members_of("class vec3;").empty());
}

TEST_CASE("definitions: text, line and base") {
  const auto found = definitions_of("\n\ndouble f() { return '}'; }\nclass cube : public hittable_list { int a; };\n");
  REQUIRE(found.size() == 2);
  CHECK(found[0].text == "inline double f() { return '}'; }");
  CHECK(found[0].line == 3);
  CHECK(found[1].text == "class cube : public hittable_list { int a; };");
  CHECK(found[1].line == 4);
  CHECK(found[1].base == "hittable_list");
}

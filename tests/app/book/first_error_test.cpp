#include "app/book/compile_program.h"

#include <doctest/doctest.h>

namespace tyndall::test::first_error_test {

namespace {

ProgramLayout layout() {
  ProgramLayout of;
  of.shown_names = {"src/main.cc", "src/triangle.h"};
  of.own_classes["frosted"] = {"material", "src/material.h"};
  of.own_classes["triangle"] = {"hittable", "src/triangle.h"};
  of.own_classes["tile"] = {"quad", "src/quad.h"};
  of.own_classes["helper"] = {"", "src/material.h"};
  return of;
}

}  // namespace

TEST_CASE("the first error at the reader's own place, in one line") {
  CHECK(first_error("In file included from src/main.cc:1:\nsrc/main.cc:3:7: error: 'x' was not declared in this scope\n"
                    "    3 | x;\nsrc/main.cc:9:1: error: another\n",
                    layout()) == "src/main.cc:3:7: 'x' was not declared in this scope");
  CHECK(first_error("src/main.cc:2:10: fatal error: no.h: No such file or directory\n", layout()) ==
        "src/main.cc:2:10: no.h: No such file or directory");
}

TEST_CASE("an error inside of a template is told at the reader's line that needed it") {
  const std::string gcc =
      "/usr/include/c++/12/bits/construct.h:119:7:   required from 'here'\n"
      "src/main.cc:6:56:   required from here\n"
      "/usr/include/c++/12/bits/construct.h:119:7: error: no matching function for call to 'sphere::sphere(int)'\n";
  CHECK(first_error(gcc, layout()) == "src/main.cc:6:56: no matching function for call to 'sphere::sphere(int)'");
  const std::string clang =
      "/usr/include/c++/12/bits/construct.h:119:7: error: no matching constructor for initialization of 'sphere'\n"
      "/usr/include/x.h:5:1: note: in instantiation of member function 'f' requested here\n"
      "src/main.cc:6:37: note: in instantiation of function template 'make_shared' requested here\n";
  CHECK(first_error(clang, layout()) == "src/main.cc:6:37: no matching constructor for initialization of 'sphere'");
}

TEST_CASE("classes of the reader's own are named, those that are none of the scene's are not") {
  CHECK(first_error("src/main.cc:4:9: error: 'frosted' was not declared in this scope\n", layout()) ==
        "src/main.cc:4:9: frosted: Tyndall has no such material (a class of your own in src/material.h)");
  CHECK(first_error("src/main.cc:4:9: error: 'tile' was not declared in this scope\n", layout()) ==
        "src/main.cc:4:9: tile: Tyndall has no such shape (a class of your own in src/quad.h)");
  CHECK(first_error("src/main.cc:4:9: error: unknown type name 'helper'\n", layout()) ==
        "src/main.cc:4:9: unknown type name 'helper'");
  CHECK(first_error("src/triangle.h:8:9: error: 'edge' was not declared in this scope\n", layout()) ==
        "src/main.cc: triangle: Tyndall has no such shape (a class of your own in src/triangle.h)");
}

TEST_CASE("what ours may lack is told so, where they stand in the place of the reader's") {
  ProgramLayout of = layout();
  of.replaced = {{"src/vec3.h", {}}};
  CHECK(first_error("src/main.cc:4:9: error: 'struct vec3' has no member named 'w'\n", of) ==
        "src/main.cc:4:9: 'struct vec3' has no member named 'w'; Tyndall's headers stand in the place of yours");
  CHECK(first_error("src/main.cc:4:9: error: expected ';' before 'x'\n", of) ==
        "src/main.cc:4:9: expected ';' before 'x'");
}

TEST_CASE("what the linker misses, and what nobody understands") {
  CHECK(first_error("/usr/bin/ld: /tmp/x.o: in function `main':\nmain.cc:(.text+0x9): undefined reference to `f()'\n",
                    layout()) ==
        "src/main.cc: undefined reference to `f()' (if it is in another source file, name that, too: tyndall main.cc "
        "other.cc; libraries are not linked)");
  CHECK(first_error("g++: out of luck\n", layout()) == "src/main.cc: cannot be compiled: g++: out of luck");
  CHECK(first_error("", layout()) == "src/main.cc: cannot be compiled: the compiler does not say why");
}

}  // namespace tyndall::test::first_error_test

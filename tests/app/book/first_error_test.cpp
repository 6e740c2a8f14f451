#include "app/book/compile_program.h"

#include <doctest/doctest.h>

namespace tyndall::test::first_error_test {

TEST_CASE("the first error, in one line, with the file as the user names it") {
  const std::string here = std::filesystem::current_path().string();
  const std::string output = "In file included from all.cc:2:\n" + here +
                             "/src/main.cc:3:7: error: 'x' was not declared\n" + "    3 | x;\n" + here +
                             "/src/main.cc:9:1: error: another\n";
  CHECK(first_error(output, "src/main.cc") == "src/main.cc:3:7: 'x' was not declared");
  CHECK(first_error(here + "/inc/a.h:2:10: fatal error: no.h: No such file or directory\n", "src/main.cc") ==
        "inc/a.h:2:10: no.h: No such file or directory");
}

TEST_CASE("a function that no source file has; a compiler that says nothing") {
  CHECK(first_error("main.o: undefined reference to `balls()'\ncollect2: error: ld returned 1 exit status\n",
                    "main.cc") ==
        "main.cc: undefined reference to `balls()' (if it is in another source file, name that, too: tyndall main.cc "
        "other.cc; libraries are not linked)");
  CHECK(first_error("", "main.cc") == "main.cc: cannot be compiled: the compiler does not say why");
}

}  // namespace tyndall::test::first_error_test

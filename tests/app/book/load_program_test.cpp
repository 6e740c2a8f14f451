#include "app/book/load_program.h"

#include "app/text/values.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

namespace tyndall::test::load_program_test {

namespace fs = std::filesystem;

namespace {

/// A request for the scene of a program with this main().
ProgramRequest program_with(const std::string& main) {
  const fs::path folder = scratch_folder() / "load_program";
  fs::create_directories(folder);
  std::ofstream(folder / "main.cc") << "#include \"" << tests_folder().string()
                                    << "/book/headers/books.h\"\nint main() { " << main << " }\n";
  ProgramRequest request;
  request.sources.files = {folder / "main.cc"};
  request.trusted = true;
  return request;
}

}  // namespace

TEST_CASE("names of programs") {
  CHECK(is_program("main.cc"));
  CHECK(is_program("a.b/c.cpp"));
  CHECK(is_program("../x.cxx"));
  CHECK_FALSE(is_program("cover"));
  CHECK_FALSE(is_program("main.cc.json"));
  CHECK_FALSE(is_program(".cc"));
  CHECK_FALSE(is_program(""));
}

TEST_CASE("a program without end is ended") {
  ProgramRequest request = program_with("for (volatile int i = 0;;) i = 1;");
  request.seconds = 0.5;
  const std::string name = request.sources.files[0].string();
  CHECK_THROWS_WITH_AS(load_program(request),
                       (name + ": did not come to the colour of its first ray within 0.5 s, and was ended").c_str(),
                       UsageError);
}

TEST_CASE("a program that nobody waits for any more is given up, also while it is compiled") {
  ProgramRequest request = program_with("for (volatile int i = 0;;) i = 1;");
  request.go_on = [] { return false; };
  CHECK_THROWS_AS(load_program(request), ProgramInterrupted);
}

}  // namespace tyndall::test::load_program_test

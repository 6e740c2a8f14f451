#include "app/book/load_program.h"
#include "app/book/compile_program.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/system/signals.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>

namespace tyndall::test::load_program_test {
namespace fs = std::filesystem;

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

namespace {

ProgramTask task() {
  ProgramTask task;
  task.name = "main.cc";
  task.folder = std::filesystem::canonical(scratch_folder("run_guarded"));
  task.trusted = true;
  return task;
}

ChildPlan shell(const std::string& script) {
  ChildPlan plan;
  plan.command = {"sh", "-c", script};
  plan.folder = "/";
  plan.seconds = 20;
  return plan;
}

}  // namespace

TEST_CASE("a program has the rights of the guard that there is") {
  ProgramTask one = task();
  one.trusted = false;
  if (!available_guard().any()) {
    CHECK_THROWS_AS(run_guarded(one, shell(""), "it ran"), UsageError);
    return;
  }
  const std::string kept = (scratch_folder("run_guarded_kept") / "kept").string();
  CHECK(run_guarded(one, shell("touch " + kept), "it ran").exit_code != 0);
  CHECK(run_guarded(one, shell("touch " + one.folder.string() + "/own"), "it ran").exit_code == 0);
}

TEST_CASE("a signal ends the program, and whoever watched before learns of it, too") {
  static volatile std::sig_atomic_t seen = 0;
  const auto before = std::signal(SIGTERM, [](int number) { seen = number; });
  auto outer = std::make_unique<SignalWatch>(WatchedSignals::end);
  ProgramTask one = task();
  one.go_on = [] { return std::raise(SIGTERM) == 0; };
  try {
    run_guarded(one, shell("sleep 60"), "it ran");
    FAIL("it was not interrupted");
  } catch (const ProgramInterrupted& end) {
    CHECK(end.signal == SIGTERM);
    CHECK(std::string(end.what()) == "main.cc: interrupted while it ran");
  }
  CHECK(outer->received() == SIGTERM);
  CHECK(seen == 0);
  outer.reset();
  std::raise(SIGTERM);
  CHECK(seen == SIGTERM);  // it is in its place again
  std::signal(SIGTERM, before);
}

TEST_CASE("a program that nobody wants any more is given up") {
  ProgramTask one = task();
  one.go_on = [] { return false; };
  CHECK_THROWS_WITH_AS(run_guarded(one, shell("sleep 60"), "it ran"), "main.cc: given up while it ran",
                       ProgramInterrupted);
}

}  // namespace tyndall::test::load_program_test

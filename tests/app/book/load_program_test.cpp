#include "app/book/load_program.h"
#include "app/book/compile_program.h"
#include "core/base/error.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>

namespace tyndall::test::load_program_test {
namespace fs = std::filesystem;

TEST_CASE("the first error of a compiler, in one line, with the file as the user names it") {
  const std::string here = fs::current_path().string();
  CHECK(first_error("In file included from all.cc:2:\n" + here + "/src/main.cc:3:7: error: 'x' was not declared\n" +
                        "    3 | x;\n" + here + "/src/main.cc:9:1: error: another\n",
                    "src/main.cc") == "src/main.cc:3:7: 'x' was not declared");
  CHECK(first_error(here + "/inc/a.h:2:10: fatal error: no.h: No such file or directory\n", "src/main.cc") ==
        "inc/a.h:2:10: no.h: No such file or directory");
  CHECK(first_error("main.o: undefined reference to `balls()'\ncollect2: error: ld returned 1 exit status\n",
                    "main.cc") ==
        "main.cc: undefined reference to `balls()' (if it is in another source file, name that, too: tyndall main.cc "
        "other.cc; libraries are not linked)");
  CHECK(first_error("", "main.cc") == "main.cc: cannot be compiled: the compiler does not say why");
}

TEST_CASE("names of programs") {
  for (const char* name : {"main.cc", "a.b/c.cpp", "../x.cxx"}) CHECK(is_program(name));
  for (const char* name : {"cover", "main.cc.json", ".cc", ""}) CHECK_FALSE(is_program(name));
}

TEST_CASE("a program without end is ended; one that is not wanted any more is given up, also while it is compiled") {
  const fs::path main = scratch_folder("load_program") / "main.cc";
  const fs::path headers = tests_folder().parent_path() / "assets/examples/book/tracer";
  write_text(main, "#include \"rtweekend.h\"\nint main() { for (volatile int i = 0;;) i = 1; }\n");
  ProgramTask request;
  request.sources = {{main}, {headers}};
  request.trusted = true;
  request.seconds = 0.5;
  CHECK_THROWS_WITH_AS(
      load_program(request),
      (main.string() + ": did not come to the colour of its first ray within 0.5 s, and was ended").c_str(),
      UsageError);
  request.go_on = [] { return false; };
  CHECK_THROWS_WITH_AS(load_program(request), (main.string() + ": given up while it was compiled").c_str(),
                       ProgramInterrupted);
}

namespace {

ChildEnd run_shell(const std::string& script, bool trusted = false, std::function<bool()> go_on = {}) {
  ProgramTask task;
  task.name = "main.cc", task.trusted = trusted, task.go_on = std::move(go_on);
  task.folder = fs::canonical(scratch_folder("run_guarded"));
  ChildPlan plan;
  plan.command = {"sh", "-c", script}, plan.folder = "/";
  return run_guarded(task, plan, "it ran");
}

}  // namespace

TEST_CASE("a program has the rights of the guard that there is") {
  if (!available_guard().any()) {
    CHECK_THROWS_AS(run_shell(""), UsageError);
    return;
  }
  CHECK(run_shell("touch " + (fs::canonical(scratch_folder("run_guarded_kept")) / "kept").string()).exit_code != 0);
  CHECK(run_shell("touch " + (fs::canonical(scratch_folder("run_guarded")) / "own").string()).exit_code == 0);
}

TEST_CASE("a signal ends the program") {
  try {
    run_shell("sleep 60", true, [] { return std::raise(SIGTERM) == 0; });
    FAIL("it was not interrupted");
  } catch (const ProgramInterrupted& end) {
    CHECK(end.signal == SIGTERM);
    CHECK(std::string(end.what()) == "main.cc: interrupted while it ran");
  }
}

}  // namespace tyndall::test::load_program_test

#include "app/book/run_guarded.h"

#include "core/base/error.h"
#include "core/system/signals.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <csignal>
#include <memory>

namespace tyndall::test::run_guarded_test {

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

}  // namespace tyndall::test::run_guarded_test

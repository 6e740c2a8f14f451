#include "core/system/child.h"

#include "tests/support/guards.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace tyndall::test::child_test {

namespace {

ChildPlan shell(const std::string& script) {
  ChildPlan plan;
  plan.command = {"sh", "-c", script};
  plan.folder = "/";
  plan.seconds = 20;
  return plan;
}

/// Within a second; what nobody has waited for yet counts as gone.
bool is_gone(int process) {
  for (int k = 0; k < 100; ++k) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    if (kill(process, 0) != 0 || (file >> number >> name >> state && state == "Z")) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// How many processes of "sleep SECONDS" there are.
int count_sleeping(const std::string& seconds) {
  int count = 0;
  std::error_code error;
  for (const auto& process : std::filesystem::directory_iterator("/proc", error)) {
    std::string text;
    std::getline(std::ifstream(process.path() / "cmdline"), text);  // throws nothing where the process ends meanwhile
    count += text == std::string("sleep\0", 6) + seconds + '\0' ? 1 : 0;
  }
  return count;
}

double seconds_of(const ChildPlan& plan, ChildEnd& end) {
  const auto begin = std::chrono::steady_clock::now();
  end = run_child(plan);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("a child's exit code, its errors, its channel, and its variables") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  ChildPlan plan = shell("echo $ONE >&2; echo out; echo told >&$PIPE; exit 3");
  setenv("ONE", "of this process", 1);  // shells take the last of several
  plan.environment = {"ONE=1 and more", "PIPE=" + std::to_string(ends[1])};
  plan.channel = ends[1];
  const ChildEnd end = run_child(plan);
  char told[5] = {};
  CHECK(read(ends[0], told, 5) == 5);
  for (const int one : ends) close(one);
  CHECK(end.exit_code == 3);
  CHECK(end.errors == "1 and more\n");
  CHECK(std::string(told, 5) == "told\n");
  CHECK_FALSE(end.ended());
}

TEST_CASE("errors are kept from the first or from the last on") {
  ChildPlan plan = shell("printf 0123456789 >&2");
  plan.max_errors = 4;
  CHECK(run_child(plan).errors == "0123");
  plan.keep_last_errors = true;
  CHECK(run_child(plan).errors == "6789");
}

TEST_CASE("a child that is ended by a signal, one that is not there, one without a folder") {
  CHECK(run_child(shell("kill -SEGV $$")).signal == SIGSEGV);
  ChildPlan plan = shell("");
  plan.command = {"/nowhere/program"};
  CHECK(run_child(plan).start_error == ENOENT);
  plan = shell("");
  plan.folder = "/nowhere";
  CHECK(run_child(plan).start_error == ENOENT);
}

TEST_CASE("a child that takes too long is ended, with all that it has started") {
  ChildPlan plan = shell("(sleep 60; echo late) & sleep 60");
  plan.seconds = 0.2;
  ChildEnd end;
  CHECK(seconds_of(plan, end) < 10);
  CHECK(end.timed_out);
}

TEST_CASE("what a child has left running is ended with it") {
  ChildPlan plan = shell("sleep 60 2>&1 & echo $! >&2");
  ChildEnd end;
  CHECK(seconds_of(plan, end) < 10);
  REQUIRE(end.exit_code == 0);
  CHECK(is_gone(std::stoi(end.errors)));
}

TEST_CASE("a child's files have a limit") {
  ChildPlan plan = shell("head -c 100000 /dev/zero >" + (scratch_folder("child") / "large").string());
  plan.max_file = 50000;
  CHECK_FALSE(run_child(plan).succeeded());
}

TEST_CASE("a child that nobody wants any more is ended") {
  ChildPlan plan = shell("sleep 60");
  int asked = 0;
  plan.go_on = [&asked] { return ++asked < 5; };
  ChildEnd end;
  CHECK(seconds_of(plan, end) < 10);
  CHECK(end.given_up);
}

TEST_CASE("a child that waits for input is ended, where the system tells") {
  if (!std::filesystem::exists("/proc/self/syscall")) return;
  ChildPlan plan = shell("read word");
  ChildEnd end;
  CHECK(seconds_of(plan, end) < 10);
  CHECK(end.awaited_input);
}

TEST_CASE("a child's process has no open file but its own") {
  const int open_file = open("/dev/null", O_RDONLY);  // not closed by exec
  const ChildEnd end = run_child(shell("test ! -e /proc/self/fd/" + std::to_string(open_file)));
  close(open_file);
  CHECK(end.exit_code == 0);
}

TEST_CASE("a child is not started without all of its pipes") {
  rlimit limit{};
  REQUIRE(getrlimit(RLIMIT_NOFILE, &limit) == 0);
  const int first_free = dup(0);
  close(first_free);
  for (int free = 0; free < 6; ++free) {  // two for each of three
    const rlimit few{static_cast<rlim_t>(first_free + free), limit.rlim_max};
    setrlimit(RLIMIT_NOFILE, &few);
    const ChildEnd end = run_child(shell(""));
    setrlimit(RLIMIT_NOFILE, &limit);
    CHECK(end.start_error == EMFILE);
  }
}

TEST_CASE("a child ends with all that it has started, also with what has left its group, if this process is killed") {
  for (const GuardLayers& layers : guards()) {
    CAPTURE(layers.namespaces);
    CAPTURE(layers.landlock);
    const std::string seconds = "60." + std::to_string(getpid());
    const auto wait_for = [&](int count) {
      for (int k = 0; k < 300 && count_sleeping(seconds) != count; ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return count_sleeping(seconds) == count;
    };
    const pid_t parent = fork();
    if (parent == 0) {
      ChildPlan plan = shell("setsid -f sleep " + seconds + "; sleep " + seconds + "; true");
      plan.own_folder = std::filesystem::canonical(scratch_folder("child_killed"));
      plan.guard = layers;
      run_child(plan);
      _exit(0);
    }
    CHECK(wait_for(layers.namespaces ? 2 : 1));  // without namespaces nothing may leave its group
    kill(parent, SIGKILL), waitpid(parent, nullptr, 0);
    CHECK(wait_for(0));
  }
}

}  // namespace tyndall::test::child_test

#include "core/system/child.h"

#include "core/system/open_file.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string_view>
#include <utility>

extern char** environ;

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

/// The ends of a pipe; not open if there is none, and errno says why.
struct Pipe {
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) from = OpenFile(ends[0]), to = OpenFile(ends[1]);
  }
  OpenFile from, to;
};

std::vector<char*> pointers(std::vector<std::string>& arguments) {
  std::vector<char*> all;
  for (std::string& word : arguments) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// The environment with the additions, each variable once.
std::vector<std::string> with(const std::vector<std::string>& additions) {
  std::vector<std::string> all = additions;
  for (char** one = environ; *one; ++one) {
    const std::string_view variable = *one, name = variable.substr(0, variable.find('=') + 1);
    const auto replaces = [name](const std::string& addition) { return addition.starts_with(name); };
    if (std::none_of(additions.begin(), additions.end(), replaces)) all.emplace_back(variable);
  }
  return all;
}

/// What the new process needs, made before it begins: there only functions that are safe in handlers may be called.
struct ProcessStart {
  const ChildPlan& plan;
  std::vector<std::string> command = plan.command, environment = with(plan.environment);
  std::vector<char*> arguments = pointers(command), variables = pointers(environment);
  Pipe input{}, errors{}, report{};
};

/// Signals that wait from now on; all others come.
sigset_t hold_back(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : signals) sigaddset(&set, number);
  sigprocmask(SIG_SETMASK, &set, nullptr);
  return set;
}

/// Closes all but the standard streams and these; the ends of other children's pipes would not end. -1: none.
void close_all_but(std::array<int, 4> kept) {
  std::sort(kept.begin(), kept.end());
  int from = 3;
  for (const int end : kept) {
    if (end > from) syscall(SYS_close_range, from, end - 1, 0);
    from = std::max(from, end + 1);
  }
  syscall(SYS_close_range, from, ~0U, 0);
}

/// Tells run_child() the number of the program's process, or that of an error, negative.
void report(const ProcessStart& start, int number) { start.report.to.write(&number, sizeof number); }

/// The new process becomes the program.
[[noreturn]] void become(const ProcessStart& start) {
  setsid();  // no terminal
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) std::signal(number, SIG_DFL);
  hold_back({});
  dup2(start.input.from.descriptor(), STDIN_FILENO);
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
  dup2(start.errors.to.descriptor(), STDERR_FILENO);
  const ChildPlan& plan = start.plan;
  for (const auto& [resource, bytes] :
       {std::pair(RLIMIT_AS, plan.max_memory), std::pair(RLIMIT_FSIZE, plan.max_file)}) {
    const rlimit limit{bytes, bytes};
    if (bytes > 0) setrlimit(resource, &limit);
  }
  if (plan.channel >= 0) fcntl(plan.channel, F_SETFD, 0);
  int error = EPERM;
  if (chdir(plan.folder.c_str()) != 0) {
    error = errno;
  } else if (restrict_self(plan.guard, plan.own_folder.c_str()) == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    environ = const_cast<char**>(start.variables.data());
    execvp(start.arguments[0], start.arguments.data());
    error = errno;
  }
  report(start, -error);
  _exit(127);
}

/// Waits for the program; ends it, with all that it has started, when this process gets SIGTERM. Returns how it ended.
int wait_for(pid_t program, const sigset_t& watched) {
  int status = 0, number = 0;
  for (bool ended = false; !ended;) {
    sigwait(&watched, &number);
    if (number == SIGTERM) kill(program, SIGKILL);
    for (pid_t one = 1; one > 0 && !ended;) {
      one = waitpid(-1, &status, WNOHANG);
      ended = one == program && (WIFEXITED(status) || WIFSIGNALED(status));
    }
  }
  kill(-program, SIGKILL);
  return status;
}

/// The new process starts the program, and ends as the program does, after all that the program has started. It ends
/// it on SIGTERM, which it also gets when its parent dies.
[[noreturn]] void supervise(const ProcessStart& start, pid_t parent) {
  close_all_but(
      {start.input.from.descriptor(), start.errors.to.descriptor(), start.plan.channel, start.report.to.descriptor()});
  setsid();
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int number : {SIGTERM, SIGCHLD}) std::signal(number, SIG_DFL);
  const sigset_t watched = hold_back({SIGTERM, SIGCHLD});
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  int life = -1;
  if (getppid() != parent || enter_namespaces(start.plan.guard, start.plan.own_folder.c_str(), life) != 0)
    report(start, -EPERM), _exit(127);
  const pid_t program = fork();
  if (program == 0) become(start);
  report(start, program > 0 ? program : -errno);
  close_all_but({life, -1, -1, -1});
  const int status = program > 0 ? wait_for(program, watched) : 0;
  close(life);
  while (life >= 0 && waitpid(-1, nullptr, 0) > 0) {  // the namespaces' first process ends last
  }
  if (!WIFSIGNALED(status)) _exit(WEXITSTATUS(status));
  std::signal(WTERMSIG(status), SIG_DFL);
  hold_back({});
  kill(getpid(), WTERMSIG(status));
  _exit(127);
}

/// Whether the process waits for a read of its standard input, as far as the system tells.
bool awaits_input(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/syscall");
  long call = -1;
  std::string descriptor;
  return file >> call >> descriptor && call == SYS_read && descriptor == "0x0";
}

/// The next number that report() tells; false: none will come, as the program has begun, or cannot begin.
bool next_number(const OpenFile& from, int& number) {
  std::size_t size = 0;
  return from.read(&number, sizeof number, size) == 0 && size == sizeof number;
}

/// Appends what the pipe has; closes it at its end.
void drain(OpenFile& from, std::string& text, const ChildPlan& plan) {
  char buffer[65536];
  std::size_t size = 0;
  if (from.read(buffer, sizeof buffer, size) != 0 || size == 0) {
    from.close();
    return;
  }
  text.append(buffer, size);
  if (text.size() <= plan.max_errors) return;
  if (plan.keep_last_errors)
    text.erase(0, text.size() - plan.max_errors);
  else
    text.resize(plan.max_errors);
}

/// Takes what the program writes, until it has ended, or is to be ended; then ends all processes.
void follow(const ChildPlan& plan, pid_t supervisor, pid_t program, OpenFile& errors, ChildEnd& end) {
  const auto take = [&](int milliseconds) {
    if (has_bytes(errors.descriptor(), errors ? milliseconds : 1)) drain(errors, end.errors, plan);
  };
  const Clock::time_point start = Clock::now();
  int status = 0, waits = 0;  // how often in a row it was seen to wait for input
  bool is_gone = false;
  while (end.start_error == 0 && !end.ended()) {
    is_gone = waitpid(supervisor, &status, WNOHANG) == supervisor;
    if (is_gone) break;
    take(20);
    waits = awaits_input(program) ? waits + 1 : 0;
    end.given_up = plan.go_on && !plan.go_on();
    end.timed_out = std::chrono::duration<double>(Clock::now() - start).count() > plan.seconds;
    end.awaited_input = waits > 5;
  }
  if (is_gone && WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (is_gone && WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (!is_gone) kill(supervisor, SIGTERM);
  while (!is_gone && waitpid(supervisor, &status, 0) < 0 && errno == EINTR) {
  }
  const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(500);
  while (errors && Clock::now() < deadline) take(50);
}

}  // namespace

bool runs_children() { return true; }

ChildEnd run_child(const ChildPlan& plan) {
  ChildEnd end;
  ProcessStart start{plan};
  const bool has_pipes = start.input.to && start.errors.to && start.report.to;
  const pid_t parent = getpid(), supervisor = has_pipes ? fork() : -1;
  if (supervisor == 0) supervise(start, parent);
  if (supervisor < 0) {
    end.start_error = errno;
    return end;
  }
  start.errors.to.close(), start.report.to.close();
  pid_t program = 0;
  for (int number = 0; next_number(start.report.from, number);)
    (number > 0 ? program : end.start_error) = std::abs(number);
  follow(plan, supervisor, program, start.errors.from, end);
  return end;
}

}  // namespace tyndall

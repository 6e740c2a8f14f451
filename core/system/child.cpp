#include "core/system/child.h"

#include "core/system/open_file.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

extern char** environ;

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

/// What the new process needs, made before it begins: there only functions that are safe in handlers may be called.
struct ProcessStart {
  std::vector<std::string> environment;
  std::vector<char*> arguments, variables;
  std::string folder;
  Guard guard;
  int input, errors, channel, report;  ///< descriptors; channel: -1, none
  std::size_t max_memory, max_file;
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
    const std::string variable = *one;
    const std::string name = variable.substr(0, variable.find('=') + 1);
    bool replaced = false;
    for (const std::string& addition : additions) replaced = replaced || addition.rfind(name, 0) == 0;
    if (!replaced) all.push_back(variable);
  }
  return all;
}

void die_with_parent(int signal) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, signal);
#endif
}

/// Closes all but the standard streams and the ends of pipes that are needed; those of other children would not end.
void close_others(const ProcessStart& start) {
#ifdef __linux__
  int kept[] = {start.input, start.errors, start.channel, start.report};
  std::sort(std::begin(kept), std::end(kept));
  int from = 3;
  for (const int end : kept) {
    if (end > from) syscall(SYS_close_range, from, end - 1, 0);
    from = std::max(from, end + 1);
  }
  syscall(SYS_close_range, from, ~0U, 0);
#endif
}

/// Tells run_child() the number of the program's process, or that of an error, negative.
void report(const ProcessStart& start, int number) {
  [[maybe_unused]] const auto told = write(start.report, &number, sizeof number);
}

/// Sets a limit that there is.
template <class Resource>
void limit(Resource resource, std::size_t bytes) {
  const rlimit most{bytes, bytes};
  if (bytes > 0) setrlimit(resource, &most);
}

/// The new process becomes the program.
[[noreturn]] void become(const ProcessStart& start) {
  setsid();  // no terminal
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) std::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(start.input, STDIN_FILENO);
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
  dup2(start.errors, STDERR_FILENO);
  limit(RLIMIT_AS, start.max_memory), limit(RLIMIT_FSIZE, start.max_file);
  if (start.channel >= 0) fcntl(start.channel, F_SETFD, 0);
  int error = EPERM;
  if (chdir(start.folder.c_str()) != 0) {
    error = errno;
  } else if (start.guard.restrict_self() == 0) {
    die_with_parent(SIGKILL);
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
  close_others(start);
  setsid();
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  sigset_t watched;
  sigemptyset(&watched);
  for (const int number : {SIGTERM, SIGCHLD}) std::signal(number, SIG_DFL), sigaddset(&watched, number);
  sigprocmask(SIG_SETMASK, &watched, nullptr);
  die_with_parent(SIGTERM);
  int life = -1;
  if (getppid() != parent || start.guard.enter_namespaces(life) != 0) report(start, -EPERM), _exit(127);
  const pid_t program = fork();
  if (program == 0) become(start);
  report(start, program > 0 ? program : -errno);
  for (const int end : {start.input, start.errors, start.channel, start.report}) close(end);
  const int status = program > 0 ? wait_for(program, watched) : 0;
  close(life);
  while (life >= 0 && waitpid(-1, nullptr, 0) > 0) {  // the namespaces' first process ends last
  }
  if (!WIFSIGNALED(status)) _exit(WEXITSTATUS(status));
  std::signal(WTERMSIG(status), SIG_DFL);
  sigemptyset(&watched);
  sigprocmask(SIG_SETMASK, &watched, nullptr);
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
void drain(OpenFile& from, std::string& text, std::size_t limit, bool keep_last) {
  char buffer[65536];
  std::size_t size = 0;
  if (from.read(buffer, sizeof buffer, size) != 0 || size == 0) {
    from.close();
    return;
  }
  text.append(buffer, size);
  if (text.size() <= limit) return;
  if (keep_last)
    text.erase(0, text.size() - limit);
  else
    text.resize(limit);
}

class Child {
 public:
  Child(const ChildPlan& plan, pid_t supervisor, pid_t program, OpenFile& errors)
      : plan_(plan), supervisor_(supervisor), program_(program), errors_(errors) {}

  /// Until it has ended, or is to be ended.
  void follow(ChildEnd& end) {
    const Clock::time_point start = Clock::now();
    int waits = 0;  // how often in a row it was seen to wait for input
    while (!collect(end)) {
      take(end, 20);
      waits = awaits_input(program_) ? waits + 1 : 0;
      end.given_up = plan_.go_on && !plan_.go_on();
      end.timed_out = std::chrono::duration<double>(Clock::now() - start).count() > plan_.seconds;
      end.awaited_input = waits > 5;
      if (end.ended()) return;
    }
  }
  /// Ends all processes, and takes what they have written.
  void finish(ChildEnd& end) {
    if (!ended_) kill(supervisor_, SIGTERM);
    int status = 0;
    while (!ended_ && waitpid(supervisor_, &status, 0) < 0 && errno == EINTR) {
    }
    const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(500);
    while (errors_ && Clock::now() < deadline) take(end, 50);
  }

 private:
  bool collect(ChildEnd& end) {
    int status = 0;
    if (waitpid(supervisor_, &status, WNOHANG) != supervisor_) return false;
    ended_ = true;
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    return true;
  }
  void take(ChildEnd& end, int milliseconds) {
    if (has_bytes(errors_.descriptor(), errors_ ? milliseconds : 1))
      drain(errors_, end.errors, plan_.max_errors, plan_.keep_last_errors);
  }

  const ChildPlan& plan_;
  pid_t supervisor_, program_;
  OpenFile& errors_;
  bool ended_ = false;
};

}  // namespace

bool runs_children() { return true; }

ChildEnd run_child(const ChildPlan& plan) {
  ChildEnd end;
  auto [input, no_input] = OpenFile::pipe();
  auto [errors, to_errors] = OpenFile::pipe();
  auto [reports, to_reports] = OpenFile::pipe();
  for (const OpenFile* file : {&input, &errors, &reports}) end.start_error = std::max(end.start_error, file->error());
  if (end.start_error != 0) return end;
  std::vector<std::string> command = plan.command, additions = plan.environment;
  if (plan.channel >= 0) additions.push_back(plan.channel_variable + "=" + std::to_string(plan.channel));
  ProcessStart start{with(additions),
                     pointers(command),
                     {},
                     plan.folder.string(),
                     Guard(plan.guard, plan.own_folder.string()),
                     input.descriptor(),
                     to_errors.descriptor(),
                     plan.channel,
                     to_reports.descriptor(),
                     plan.max_memory,
                     plan.max_file};
  start.variables = pointers(start.environment);
  const pid_t parent = getpid(), supervisor = fork();
  if (supervisor == 0) supervise(start, parent);
  if (supervisor < 0) {
    end.start_error = errno;
    return end;
  }
  to_errors.close(), to_reports.close();
  pid_t program = 0;
  for (int number = 0; next_number(reports, number);) (number > 0 ? program : end.start_error) = std::abs(number);
  Child child(plan, supervisor, program, errors);
  if (end.start_error == 0) child.follow(end);
  child.finish(end);
  return end;
}

}  // namespace tyndall

#include "app/book/child.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

extern char** environ;

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t max_messages = std::size_t(300) << 20;  // more than the largest scene

std::atomic<int> received_signal{0};  // a signal handler can reach nothing but globals
constexpr int watched[] = {SIGINT, SIGTERM, SIGHUP};
struct sigaction before[3];

/// Keeps the signal in mind, and passes it on to who watched before.
void on_signal_number(int number) {
  received_signal = number;
  for (std::size_t k = 0; k < 3; ++k)
    if (watched[k] == number && before[k].sa_handler != SIG_DFL && before[k].sa_handler != SIG_IGN)
      before[k].sa_handler(number);
}

/// Watches signals that ask for the end while it lives. What is ignored stays so, but for SIGINT: shells ignore it for
/// jobs in the background, which "kill -INT" must still reach.
class EndWatch {
 public:
  explicit EndWatch(bool watches) : watches_(watches) {
    received_signal = 0;
    struct sigaction action {};
    action.sa_handler = on_signal_number;
    for (std::size_t k = 0; watches_ && k < 3; ++k) {
      sigaction(watched[k], nullptr, &before[k]);
      const bool ignored = before[k].sa_handler == SIG_IGN;
      if (!ignored || watched[k] == SIGINT) sigaction(watched[k], &action, nullptr);
    }
  }
  ~EndWatch() {
    for (std::size_t k = 0; watches_ && k < 3; ++k) sigaction(watched[k], &before[k], nullptr);
  }
  EndWatch(const EndWatch&) = delete;
  EndWatch& operator=(const EndWatch&) = delete;
  int received() const { return watches_ ? received_signal.load() : 0; }

 private:
  bool watches_;
};

/// Both ends of a pipe, closed at the end.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) read = ends[0], write = ends[1];
  }
  ~Pipe() { close_end(read), close_end(write); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close_end(int& end) {
    if (end >= 0) close(std::exchange(end, -1));
  }
};

/// What the new process needs, made before it begins: there only functions that are safe in handlers may be called.
struct ProcessStart {
  std::vector<std::string> environment;
  std::vector<char*> arguments, variables;
  std::string folder;
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

[[noreturn]] void become(const ProcessStart& start, const Pipe& input, const Pipe& errors, int messages, int report) {
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  for (const int number : watched) std::signal(number, SIG_DFL);
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(input.read, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(errors.write, STDERR_FILENO);
  if (messages >= 0) fcntl(messages, F_SETFD, 0);
  if (chdir(start.folder.c_str()) == 0) execvpe(start.arguments[0], start.arguments.data(), start.variables.data());
  const int error = errno;
  [[maybe_unused]] const auto told = write(report, &error, sizeof error);
  _exit(127);
}

/// Whether the process waits for a read of its standard input, as far as the system tells.
bool awaits_input(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/syscall");
  long call = -1;
  std::string descriptor;
  return file >> call >> descriptor && call == SYS_read && descriptor == "0x0";
}

/// Appends what the pipe has; closes it at its end.
void drain(int& from, std::string& text, std::size_t limit, bool keep_last) {
  char buffer[65536];
  const ssize_t size = read(from, buffer, sizeof buffer);
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (size <= 0) return Pipe::close_end(from);
  text.append(buffer, static_cast<std::size_t>(size));
  if (text.size() <= limit) return;
  if (keep_last)
    text.erase(0, text.size() - limit);
  else
    text.resize(limit);
}

class Child {
 public:
  Child(const ChildPlan& plan, pid_t process, Pipe& errors, Pipe& messages)
      : plan_(plan), process_(process), errors_(errors), messages_(messages) {}

  /// Until it has ended, or is to be ended.
  void follow(const EndWatch& signals, ChildEnd& end) {
    Clock::time_point deadline = in(plan_.seconds);
    bool told = false;
    int waits = 0;  // how often in a row it was seen to wait for input
    while (!collect(end)) {
      take(end, 20);
      if (!std::exchange(told, !end.messages.empty()) && !end.messages.empty())
        deadline = std::min(deadline, in(plan_.seconds_after_message));
      waits = awaits_input(process_) ? waits + 1 : 0;
      end.interrupted = signals.received();
      end.given_up = plan_.go_on && !plan_.go_on();
      end.timed_out = Clock::now() > deadline;
      end.awaited_input = waits > 5;
      if (end.ended()) return;
    }
  }
  /// Ends all processes of the group, and takes what they have written.
  void finish(ChildEnd& end) {
    kill(-process_, SIGKILL);
    int status = 0;
    while (!ended_ && waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(500);
    while ((errors_.read >= 0 || messages_.read >= 0) && Clock::now() < deadline) take(end, 50);
  }

 private:
  static Clock::time_point in(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  bool collect(ChildEnd& end) {
    int status = 0;
    if (waitpid(process_, &status, WNOHANG) != process_) return false;
    ended_ = true;
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    return true;
  }
  void take(ChildEnd& end, int milliseconds) {
    pollfd polled[2] = {{errors_.read, POLLIN, 0}, {messages_.read, POLLIN, 0}};
    if (poll(polled, 2, milliseconds) <= 0) return;
    if (polled[0].revents) drain(errors_.read, end.errors, plan_.max_errors, plan_.keep_last_errors);
    if (polled[1].revents) drain(messages_.read, end.messages, max_messages, false);
  }

  const ChildPlan& plan_;
  pid_t process_;
  Pipe &errors_, &messages_;
  bool ended_ = false;
};

}  // namespace

ChildEnd run_child(const ChildPlan& plan) {
  ChildEnd end;
  const EndWatch signals(plan.watch_signals);
  Pipe input, errors, messages, report;
  if (report.read < 0 || messages.read < 0) {
    end.start_error = errno;
    return end;
  }
  std::vector<std::string> command = plan.command, additions = plan.environment;
  if (!plan.pipe_variable.empty()) additions.push_back(plan.pipe_variable + "=" + std::to_string(messages.write));
  ProcessStart start{with(additions), pointers(command), {}, plan.folder.string()};
  start.variables = pointers(start.environment);
  const pid_t process = fork();
  if (process == 0) become(start, input, errors, plan.pipe_variable.empty() ? -1 : messages.write, report.write);
  if (process < 0) {
    end.start_error = errno;
    return end;
  }
  setpgid(process, process);  // here, too: whoever comes first
  Pipe::close_end(errors.write), Pipe::close_end(messages.write), Pipe::close_end(report.write);
  Child child(plan, process, errors, messages);
  int error = 0;
  if (read(report.read, &error, sizeof error) == sizeof error) end.start_error = error;
  if (end.start_error == 0) child.follow(signals, end);
  child.finish(end);
  return end;
}

std::string signal_name(int signal) {
  constexpr std::pair<int, const char*> names[] = {{SIGSEGV, "SIGSEGV, a pointer to nowhere"},
                                                   {SIGABRT, "SIGABRT"},
                                                   {SIGFPE, "SIGFPE, a division by 0"},
                                                   {SIGBUS, "SIGBUS"},
                                                   {SIGILL, "SIGILL"},
                                                   {SIGKILL, "SIGKILL, often for lack of memory"},
                                                   {SIGTERM, "SIGTERM"},
                                                   {SIGXCPU, "SIGXCPU"},
                                                   {SIGXFSZ, "SIGXFSZ, a file that is too large"}};
  for (const auto& [number, name] : names)
    if (number == signal) return name;
  return "signal " + std::to_string(signal);
}

}  // namespace tyndall

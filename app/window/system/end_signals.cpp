#include "app/window/system/end_signals.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <utility>

namespace tyndall {
namespace {

// A signal handler can reach nothing but globals.
std::atomic<int> received_signal{0};
int pipe_ends[2] = {-1, -1};
struct sigaction before[3];
constexpr int watched[3] = {SIGINT, SIGTERM, SIGHUP};

void tell() {
  constexpr char byte = 0;
  [[maybe_unused]] const auto written = write(pipe_ends[1], &byte, 1);
}

void on_signal_number(int number) {
  received_signal = number;
  tell();
}

using Handler = int (*)(void* display);

/// The X library's handler gets no argument of its own.
std::function<std::string()>& last_wish() {
  static std::function<std::string()> wish;
  return wish;
}

/// Ends the program, as X demands of such a handler. Destructors are left out: they would talk to the lost server.
int on_lost(void*) {
  const std::string more = last_wish() ? last_wish()() : "";
  const std::string text = "tyndall: the display went away\n" + (more.empty() ? "" : "tyndall: " + more + "\n");
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
  _exit(3);
}

}  // namespace

EndSignals::EndSignals(std::function<void()> on_signal) {
  received_signal = 0;
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) return;  // then the signals end the program at once
  thread_ = std::thread([call = std::move(on_signal)] {
    char byte = 0;
    if (read(pipe_ends[0], &byte, 1) == 1 && received_signal != 0) call();
  });
  struct sigaction action {};
  action.sa_handler = on_signal_number;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (int k = 0; k < 3; ++k) {
    sigaction(watched[k], nullptr, &before[k]);
    // Shells ignore SIGINT for jobs in the background, which "kill -INT" must still reach; nohup ignores SIGHUP.
    const bool ignored = before[k].sa_handler == SIG_IGN;
    if (!ignored || watched[k] == SIGINT) sigaction(watched[k], &action, nullptr);
  }
}

EndSignals::~EndSignals() {
  if (!thread_.joinable()) return;
  for (int k = 0; k < 3; ++k) sigaction(watched[k], &before[k], nullptr);
  tell();
  thread_.join();
  for (int& end : pipe_ends) close(std::exchange(end, -1));
}

int EndSignals::received() const { return received_signal; }

void end_when_display_is_lost(std::function<std::string()> before_end) {
  last_wish() = std::move(before_end);
  std::signal(SIGPIPE, SIG_IGN);  // comes first when the connection breaks, and would end the program without a message
  // The window library loads X by itself; linking it here would tie the program to it.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
  if (!library) return;
  const auto set_handler = reinterpret_cast<Handler (*)(Handler)>(dlsym(library, "XSetIOErrorHandler"));
  if (set_handler) set_handler(on_lost);
}

}  // namespace tyndall

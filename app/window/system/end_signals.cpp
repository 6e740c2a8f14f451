#include "app/window/system/end_signals.h"

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

}  // namespace tyndall

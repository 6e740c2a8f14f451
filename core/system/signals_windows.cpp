#include "core/system/signals.h"

#include "core/system/windows_api.h"

#include <csignal>
#include <cstdlib>
#include <utility>

namespace tyndall {
namespace {

std::atomic<int> received_signal{0};
std::atomic<ULONGLONG> received_at{0};            ///< milliseconds
std::atomic<int> watches{0}, patient_watches{0};  ///< that live; those of them that no second event ends

/// What comes within this time is the same request.
constexpr ULONGLONG same_request_ms = 200;

/// The process ends when this returns for an end of the console, so it waits for the program's own end, as long as
/// Windows lets it.
BOOL WINAPI take_event(DWORD event) {
  if (watches == 0) return FALSE;
  const bool key = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
  const int number = key ? SIGINT : SIGTERM;
  int none = 0;
  if (received_signal.compare_exchange_strong(none, number)) {
    received_at = GetTickCount64();
  } else if (patient_watches == 0 && GetTickCount64() - received_at > same_request_ms) {
    std::_Exit(128 + number);
  }
  for (int k = 0; !key && watches > 0 && k < 100; ++k) Sleep(50);
  return TRUE;
}

}  // namespace

SignalWatch::SignalWatch(WatchedSignals signals, std::function<void()> on_end) {
  if (signals == WatchedSignals::none) return;
  const int patient = signals == WatchedSignals::end ? 1 : 0;
  if (watches == 0) received_signal = 0;
  patient_watches += patient;
  if (watches++ == 0) SetConsoleCtrlHandler(take_event, TRUE);
  restore_ = [patient] {
    patient_watches -= patient;
    if (--watches == 0) SetConsoleCtrlHandler(take_event, FALSE);
  };
  if (on_end) thread_.emplace([this, call = std::move(on_end)] { tell_end(call); });
}

int SignalWatch::received() const { return restore_ ? received_signal.load() : 0; }
bool SignalWatch::take_save_request() const { return false; }

void ignore_lost_pipes() {}  // they end no program here

std::string signal_name(int signal) { return "signal " + std::to_string(signal); }

}  // namespace tyndall

#include "core/system/signals.h"

#include <doctest/doctest.h>

#include <csignal>
#include <optional>

namespace tyndall::test::signals_test {

TEST_CASE("watches may be nested: each sees what comes, and gives the signals back at its end") {
  static volatile std::sig_atomic_t seen = 0;
  const auto before = std::signal(SIGTERM, [](int number) { seen = number; });
  std::optional<SignalWatch> outer(std::in_place, WatchedSignals::end);
  {
    const SignalWatch inner(WatchedSignals::end);
    std::raise(SIGTERM);
    CHECK(inner.received() == SIGTERM);
  }
  CHECK(outer->received() == SIGTERM);
  CHECK(seen == 0);
  outer.reset();
  std::raise(SIGTERM);
  CHECK(seen == SIGTERM);
  CHECK(SignalWatch(WatchedSignals::end).received() == 0);  // what came before it is none of its
  std::signal(SIGTERM, before);
}

}  // namespace tyndall::test::signals_test

#pragma once
#include "app/book/run_guarded.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace tyndall {

/// A reader's program that has come to its first ray, and from then on computes samples when it is asked. It runs under
/// guard, until this is destroyed or it ends by itself.
class OwnProgram {
 public:
  /// Starts it. name: what messages call it. It is ended if it has not told what it has in these seconds, or if go_on,
  /// which is asked now and then, says so.
  OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on);
  ~OwnProgram();
  OwnProgram(const OwnProgram&) = delete;
  OwnProgram& operator=(const OwnProgram&) = delete;

  /// What tyndall/book/hooks.h tells: a letter and a text.
  struct Message {
    char kind = 0;
    std::string text;
  };
  /// The next message; nothing: it has ended, see end().
  std::optional<Message> next_message();
  /// From now on it may take as long as it likes, and nobody is asked.
  void set_lasting();

  /// Linear colours, three numbers each, of places in pixels, two numbers each. Throws IoError where it has ended. For
  /// any number of threads.
  std::vector<double> samples(const std::vector<double>& places);

  /// How it ended, after next_message() or samples() has found that it did.
  const ChildEnd& end();

 private:
  bool is_wanted();

  Connection channel_;
  std::string name_;
  std::chrono::steady_clock::time_point deadline_;
  std::atomic<bool> stops_ = false;
  Mutex wanted_mutex_;
  std::function<bool()> go_on_;  ///< empty: it lasts
  ChildEnd end_;
  Mutex mutex_;  ///< one question at a time
  std::thread thread_;
};

}  // namespace tyndall

#pragma once
#include "app/book/own_program.h"
#include "app/files/watched_function.h"
#include "core/system/locks.h"

#include <memory>
#include <mutex>
#include <string>

namespace tyndall {

/// The samples that a reader's program computes itself, where its world is no scene. In a window the program changes
/// when it is saved; the function stays. For any number of threads.
class OwnSamples {
 public:
  OwnSamples();
  /// program: null where there is a scene; reason: why there is none, a sentence with the program's name.
  void take(std::shared_ptr<OwnProgram> program, const std::string& reason);
  std::string reason() const;
  /// How many programs were taken.
  std::uint32_t taken() const;
  /// What asks the program that was taken last.
  const std::shared_ptr<WatchedFunction>& function() const { return function_; }

 private:
  struct Held {
    Mutex mutex;
    std::shared_ptr<OwnProgram> program;
    std::string reason;
    std::uint32_t taken = 0;
  };
  static void compute(void* held, double x, double y, std::uint64_t sample, double rgb[3]);

  std::shared_ptr<Held> held_;
  std::shared_ptr<WatchedFunction> function_;  ///< keeps what is held
};

}  // namespace tyndall

#pragma once
#include "core/render/sample_source.h"
#include "core/system/locks.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

/// A function of another program that computes samples of a picture, and what is to be told of it.
namespace tyndall {

/// Asks a caller's function for samples, and remembers those that it could not compute. For any number of threads.
class WatchedFunction {
 public:
  /// Sets the linear radiance rgb at a point of the picture, see SampleSource. rgb holds NaN before.
  using Function = std::function<void(double x, double y, std::uint64_t sample, double rgb[3])>;
  /// announce: see SampleSource.
  explicit WatchedFunction(Function function, decltype(SampleSource::announce) announce = {});

  std::shared_ptr<const SampleSource> source() const { return source_; }

  /// For use within the function: the sample that this thread computes has no value, because of `reason`. Returns false
  /// where this thread computes none.
  static bool fail(const char* reason);

  /// Calls on_news, from any thread, when the first sample without a value was found. Empty: calls nothing from then
  /// on, and returns when no call is under way.
  void set_on_news(std::function<void()> on_news);
  /// "pixel (3, 4), sample 5: REASON": the first sample that was found to have no value; "": none was.
  std::string first_problem() const;
  /// The number of samples without a value, those of earlier renders included.
  std::uint64_t problems() const { return problems_; }

 private:
  Vec3f sample(double x, double y, std::uint64_t index);
  void note(double x, double y, std::uint64_t index, const std::string& reason);

  Function function_;
  std::shared_ptr<const SampleSource> source_;
  std::atomic<std::uint64_t> problems_ = 0;
  mutable Mutex mutex_;  ///< guards what follows
  std::string first_;
  std::function<void()> on_news_;
};

}  // namespace tyndall

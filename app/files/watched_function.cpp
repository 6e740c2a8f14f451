#include "app/files/watched_function.h"

#include "app/text/standard_streams.h"
#include "core/base/text.h"
#include "core/film/film.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t longest_reason = 300;  // bytes

/// What a thread computes. Without constructor and destructor, because it is looked at for each sample.
struct Computation {
  bool is_sample;                   ///< the thread has computed samples
  bool failed;                      ///< its present sample has no value
  char reason[longest_reason + 1];  ///< why not
};
thread_local Computation computation;

void set_reason(Computation& now, const char* reason) {
  now.failed = true;
  const std::size_t size = std::min(std::strlen(reason), longest_reason);
  std::memcpy(now.reason, reason, size);
  now.reason[size] = 0;
}

}  // namespace

WatchedFunction::WatchedFunction(Function function, void* user)
    : function_(function),
      user_(user),
      source_(std::make_shared<const SampleSource>(
          SampleSource{[this](double x, double y, std::uint64_t index) { return sample(x, y, index); }})) {}

Vec3f WatchedFunction::sample(double x, double y, std::uint64_t index) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Computation& now = computation;
  now.is_sample = true, now.failed = false;
  double rgb[3] = {nothing, nothing, nothing};
  try {
    function_(user_, x, y, index, rgb);
  } catch (const std::exception& error) {
    set_reason(now, error.what());
  } catch (...) {
    set_reason(now, "an exception that is no std::exception");
  }
  const Vec3f radiance{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  if (!now.failed && scaled(radiance, 1 / source_quantum).fits()) return radiance;
  note(x, y, index,
       now.failed ? now.reason
                  : fmt::format("found ({}, {}, {}), expected finite numbers, at most 7e13", rgb[0], rgb[1], rgb[2]));
  return {static_cast<float>(nothing), 0, 0};
}

bool WatchedFunction::fail(const char* reason) {
  if (!computation.is_sample) return false;
  set_reason(computation, reason ? reason : "no reason was given");
  return true;
}

void WatchedFunction::note(double x, double y, std::uint64_t index, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (++problems_ > 1) return;
  first_ = fmt::format("pixel ({}, {}), sample {}: {}", std::floor(x), std::floor(y), index,
                       printable(reason, longest_reason));
  complain(first_);
  if (on_news_) on_news_();
}

void WatchedFunction::set_on_news(std::function<void()> on_news) {
  const std::lock_guard lock(mutex_);
  on_news_ = std::move(on_news);
}

std::string WatchedFunction::first_problem() const {
  const std::lock_guard lock(mutex_);
  return first_;
}

std::uint64_t WatchedFunction::problems() const {
  const std::lock_guard lock(mutex_);
  return problems_;
}

}  // namespace tyndall

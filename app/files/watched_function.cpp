#include "app/files/watched_function.h"

#include "app/text/standard_streams.h"
#include "core/base/text.h"
#include "core/film/film.h"

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

namespace tyndall {
namespace {

/// Why the sample that this thread computes has no value; nothing: it has one. Null: this thread computes none.
thread_local std::optional<std::string>* reason_of_sample = nullptr;

}  // namespace

WatchedFunction::WatchedFunction(Function function, decltype(SampleSource::announce) announce)
    : function_(std::move(function)),
      source_(std::make_shared<const SampleSource>(SampleSource{
          [this](double x, double y, std::uint64_t index) { return sample(x, y, index); }, std::move(announce)})) {}

Vec3f WatchedFunction::sample(double x, double y, std::uint64_t index) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  double rgb[3] = {nothing, nothing, nothing};
  std::optional<std::string> reason;
  reason_of_sample = &reason;
  try {
    function_(x, y, index, rgb);
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "an exception that is no std::exception";
  }
  reason_of_sample = nullptr;
  const Vec3f radiance{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  if (!reason && scaled(radiance, 1 / source_quantum).fits()) return radiance;
  note(x, y, index,
       reason.value_or(
           fmt::format("found ({}, {}, {}), expected finite numbers, at most 7e13", rgb[0], rgb[1], rgb[2])));
  return {static_cast<float>(nothing), 0, 0};
}

bool WatchedFunction::fail(const char* reason) {
  if (reason_of_sample) *reason_of_sample = reason ? reason : "no reason was given";
  return reason_of_sample != nullptr;
}

void WatchedFunction::note(double x, double y, std::uint64_t index, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (++problems_ > 1) return;
  first_ = fmt::format("pixel ({}, {}), sample {}: {}", std::floor(x), std::floor(y), index, printable(reason));
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

}  // namespace tyndall

#include "app/files/checkpoint.h"

#include "app/files/memory.h"
#include "core/image/image_io.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t pixels_at_a_time = 4096;  ///< by one thread

/// Copies a film into another one, whose memory is used again. All threads copy parts of it, as rendering waits for it.
void copy(const Film& film, Film& to, ThreadPool& thread_pool) {
  const auto copy_all = [&thread_pool](const auto& from, auto& into) {
    into.resize(from.size());
    thread_pool.for_each(static_cast<int>((from.size() + pixels_at_a_time - 1) / pixels_at_a_time), [&](int number) {
      const std::size_t begin = pixels_at_a_time * static_cast<std::size_t>(number);
      std::copy_n(from.data() + begin, std::min(pixels_at_a_time, from.size() - begin), into.data() + begin);
    });
  };
  copy_all(film.pixels, to.pixels), copy_all(film.emission, to.emission);
  to.width = film.width, to.height = film.height, to.region = film.region, to.first_sample = film.first_sample;
  to.quantum = film.quantum, to.cut_throughput = film.cut_throughput, to.planned = film.planned;
}

}  // namespace

Checkpoints::Checkpoints(std::filesystem::path file, std::optional<double> interval,
                         std::function<Embedded(const Film&)> embedded)
    : file_(std::move(file)), interval_(interval), embedded_(std::move(embedded)) {}

bool Checkpoints::due() const {
  if (writing_) return false;
  constexpr double look_interval = 0.05;  // seconds, see RenderBreaks
  // As the next one begins earlier by twice what the last one took, they take at most 1 % of 102 times that.
  const double interval = interval_.value_or(std::max(30.0, 102 * cost_));
  const double lead = slowest_ > 0 ? 2 * slowest_ + look_interval : interval_.value_or(0);
  return seconds_since(taken_) >= std::max(interval - lead, interval / 2);
}

void Checkpoints::take(const Film& film, ThreadPool& thread_pool) {
  writer_.reset();
  taken_ = Clock::now();
  // Where the system promises more memory than it has, taking it would end the program: so what is free is looked at.
  const std::size_t bytes = film.pixels.size() * bytes_per_pixel(!film.emission.empty());
  if (copy_.pixels.empty() && free_memory().bytes < bytes) return write(film);
  try {
    copy(film, copy_, thread_pool);
    writing_ = true;
    writer_.emplace([this] {
      write(copy_);
      writing_ = false;
    });
  } catch (const std::exception&) {  // there is no memory for a copy, or no thread
    writing_ = false;
    copy_ = {};
    write(film);
  }
}

void Checkpoints::write(const Film& film) {
  constexpr const char* failed = "no checkpoint was written: ";
  try {
    write_checkpoint(file_, film, embedded_(film));
    last_problem_.clear();
  } catch (const std::bad_alloc&) {
    note(failed, "not enough memory");
  } catch (const std::exception& error) {
    note(failed, error.what());
  }
  cost_ = seconds_since(taken_);
  slowest_ = std::max(slowest_, cost_);
  const double requested = interval_.value_or(0);
  if (requested > 0 && cost_ > requested / 2 && !std::exchange(slow_, true))
    note("checkpoints take longer than half of --checkpoint; a kill can cost twice what one took: ",
         fmt::format("{:.2g} s", cost_).c_str());
}

void Checkpoints::finish() {
  writer_.reset();
  copy_ = {};
}

void Checkpoints::note(const char* what, const char* why) {
  try {
    const std::string problem = std::string(what) + why;
    if (problem == last_problem_) return;
    last_problem_ = problem;
    problem_ += (problem_.empty() ? "" : "; ") + problem;
  } catch (const std::bad_alloc&) {
    last_problem_.clear();  // no memory for the message: it is told when the next checkpoint fails, too
  }
}

std::optional<std::string> Checkpoints::problem() {
  if (writing_ || problem_.empty()) return std::nullopt;
  return std::exchange(problem_, {});
}

}  // namespace tyndall

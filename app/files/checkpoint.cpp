#include "app/files/checkpoint.h"

#include "app/files/memory.h"
#include "core/base/seconds.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace tyndall {

Checkpoints::Checkpoints(std::filesystem::path file, std::optional<double> interval,
                         std::function<Embedded(const Film&)> embedded)
    : file_(std::move(file)), interval_(interval), embedded_(std::move(embedded)) {}

Checkpoints::~Checkpoints() { finish(); }

bool Checkpoints::due() const {
  if (writing_) return false;
  const double usual = std::max(least_checkpoint_interval, checkpoint_interval_over_cost * cost_);
  return seconds_since(taken_) >= interval_.value_or(usual);
}

void Checkpoints::take(const Film& film) {
  if (writer_.joinable()) writer_.join();
  taken_ = Clock::now();
  if (!write_in_background(film)) write(film);
}

/// False if there is no memory for a copy, or no thread. Where the system promises more memory than it has, taking it
/// would end the program: so what is free is looked at.
bool Checkpoints::write_in_background(const Film& film) {
  if (copy_.pixels.empty() && free_memory().bytes < film.pixels.size() * bytes_per_pixel(!film.emission.empty()))
    return false;
  try {
    copy_ = film;
    writing_ = true;
    writer_ = std::thread([this] {
      write(copy_);
      writing_ = false;
    });
    return true;
  } catch (const std::exception&) {
    writing_ = false;
    copy_ = {};
    return false;
  }
}

void Checkpoints::write(const Film& film) {
  try {
    write_checkpoint(file_, film, embedded_(film));
    const std::lock_guard lock(mutex_);
    last_problem_.clear();
  } catch (const std::bad_alloc&) {
    note("not enough memory");
  } catch (const std::exception& error) {
    note(error.what());
  }
  cost_ = seconds_since(taken_);
}

void Checkpoints::finish() {
  if (writer_.joinable()) writer_.join();
  copy_ = {};
}

void Checkpoints::note(const char* problem) {
  try {
    const std::lock_guard lock(mutex_);
    if (problem == last_problem_) return;
    problem_ = last_problem_ = problem;
  } catch (const std::bad_alloc&) {
    last_problem_.clear();  // no memory for the message: it is told when the next checkpoint fails, too
  }
}

std::optional<std::string> Checkpoints::problem() {
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) return std::nullopt;
  return "no checkpoint was written: " + std::exchange(problem_, {});
}

}  // namespace tyndall

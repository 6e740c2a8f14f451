#include "app/files/checkpoint.h"

#include "core/base/seconds.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <exception>
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
  finish();
  taken_ = Clock::now();
  try {
    copy_ = film;
    writing_ = true;
    writer_ = std::thread([this] { write(); });
  } catch (const std::exception& error) {  // no memory for the copy, or no thread
    writing_ = false;
    copy_ = {};
    note(error.what());
  }
}

void Checkpoints::write() {
  try {
    write_checkpoint(file_, copy_, embedded_(copy_));
    const std::lock_guard lock(mutex_);
    last_problem_.clear();
  } catch (const std::exception& error) {
    note(error.what());
  }
  cost_ = seconds_since(taken_);
  writing_ = false;
}

void Checkpoints::finish() {
  if (writer_.joinable()) writer_.join();
}

void Checkpoints::note(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  if (problem == last_problem_) return;
  problem_ = last_problem_ = problem;
}

std::optional<std::string> Checkpoints::problem() {
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) return std::nullopt;
  return "no checkpoint was written: " + std::exchange(problem_, {});
}

}  // namespace tyndall

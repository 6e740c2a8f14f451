#include "core/base/error_sum.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Of equal errors, that of the earlier pixel counts as larger: so every standard library sorts them alike.
bool is_larger(const PixelError& a, const PixelError& b) {
  return a.error != b.error ? a.error > b.error : a.pixel < b.pixel;
}

}  // namespace

void ErrorSum::set_apart(PixelError one) {
  apart_.push_back(one);
  if (apart_.size() == 2 * max_apart) trim();
}

/// Leaves the largest apart, in order.
void ErrorSum::trim() {
  std::sort(apart_.begin(), apart_.end(), is_larger);
  while (apart_.size() > max_apart) {
    const double error = apart_.back().error;
    sum_ += error, squares_ += error * error;
    apart_.pop_back();
  }
  min_ = apart_.back().error;
}

void ErrorSum::add(const ErrorSum& other) {
  sum_ += other.sum_, squares_ += other.squares_;
  for (const PixelError& one : other.apart_) add(one);
}

double ErrorSum::sum() const {
  double sum = sum_;
  for (const PixelError& one : apart_) sum += one.error;
  return sum;
}

double ErrorSum::squares() const {
  double squares = squares_;
  for (const PixelError& one : apart_) squares += one.error * one.error;
  return squares;
}

std::vector<PixelError> ErrorSum::largest() const {
  std::vector<PixelError> list = apart_;
  std::sort(list.begin(), list.end(), is_larger);
  list.resize(std::min(list.size(), max_apart));
  return list;
}

void ErrorSum::replace(const std::vector<PixelError>& better) {
  for (const PixelError& one : better)
    for (PixelError& old : apart_)
      if (old.pixel == one.pixel) old.error = one.error;
}

void ask_levels(const LevelsOf& levels_of, std::size_t pixels,
                const std::function<double(std::size_t pixel, Vec3f level)>& error_at, ErrorSum& sum) {
  constexpr double decisive_fraction = 0.01, decisive_multiple = 16;  // of the sum, and of the mean
  const double fraction = std::max(decisive_fraction, decisive_multiple / static_cast<double>(pixels));
  const std::vector<PixelError> errors = sum.largest();
  for (auto next = errors.begin();;) {
    const double minimum = fraction * sum.sum();
    std::vector<std::size_t> decisive;
    while (next != errors.end() && next->error >= minimum) decisive.push_back((next++)->pixel);
    const std::vector<Vec3f> levels = decisive.empty() ? std::vector<Vec3f>() : levels_of(decisive);
    if (levels.empty()) return;
    std::vector<PixelError> better;
    for (std::size_t i = 0; i < decisive.size(); ++i) better.push_back({decisive[i], error_at(decisive[i], levels[i])});
    sum.replace(better);
  }
}

}  // namespace tyndall

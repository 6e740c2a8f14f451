#include "core/accuracy/error_sum.h"

#include <algorithm>

namespace tyndall {
namespace {

/// A strict order, so that no two standard libraries choose other pixels.
bool is_larger(const PixelError& a, const PixelError& b) {
  return a.error != b.error ? a.error > b.error : a.pixel < b.pixel;
}

}  // namespace

void ErrorSum::add(PixelError one) {
  if (one.error <= least_) {
    sum_ += one.error, squares_ += one.error * one.error;
    return;
  }
  apart_.push_back(one);
  if (apart_.size() == 2 * most_apart) trim();
}

/// Leaves the largest apart, in order.
void ErrorSum::trim() {
  std::sort(apart_.begin(), apart_.end(), is_larger);
  while (apart_.size() > most_apart) {
    const double error = apart_.back().error;
    sum_ += error, squares_ += error * error;
    apart_.pop_back();
  }
  least_ = apart_.back().error;
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
  list.resize(std::min(list.size(), most_apart));
  return list;
}

void ErrorSum::replace(const std::vector<PixelError>& better) {
  for (const PixelError& one : better)
    for (PixelError& old : apart_)
      if (old.pixel == one.pixel) old.error = one.error;
}

}  // namespace tyndall

#pragma once
#include <cmath>
#include <vector>

namespace tyndall_book {

/// Finds the size of a picture from the places that a loop asks for rays at, left to right and row by row: u = (column
/// + jitter) / width and v = (row + jitter) / height, or by width - 1 and height - 1 as in editions 2 and 3. Other
/// orders tell nothing.
class RowFollower {
 public:
  /// samples: rays a pixel. aspect_ratio: the camera's, 0 if it was given none.
  void begin(long samples, double aspect_ratio) {
    samples_ = samples;
    aspect_ratio_ = aspect_ratio;
  }
  /// A ray through that place. True: the size is known.
  bool take(double u, double v) {
    ++rays_;
    u_ += u / static_cast<double>(samples_), v_ += v / static_cast<double>(samples_);
    if (++in_pixel_ < samples_) return false;
    const bool known = take_pixel(u_, v_);
    u_ = v_ = 0;
    in_pixel_ = 0;
    return known;
  }
  bool gives_up() const { return rays_ > 6000000 || is_other_; }
  int width() const { return static_cast<int>(width_); }
  int height() const { return static_cast<int>(height_); }

 private:
  struct Row {
    long pixels = 0;
    double first_u = 0, last_u = 0, u = 0, column_u = 0, v = 0;  ///< sums of u, column * u and v over its pixels
  };

  bool take_pixel(double u, double v) {
    bool known = false;
    if (row_.pixels > 0 && u < row_.last_u - 0.05) {
      known = is_in_row_ && end_row();
      is_in_row_ = true;  // rows before the first end of one are incomplete
      row_ = Row();
    }
    if (row_.pixels == 0) row_.first_u = u;
    row_.last_u = u;
    row_.u += u;
    row_.column_u += static_cast<double>(row_.pixels) * u;
    row_.v += v;
    ++row_.pixels;
    return known;
  }

  bool end_row() {
    const auto count = static_cast<double>(row_.pixels), edge = 1.6 / count;
    if (row_.pixels < 8 || row_.first_u > edge || row_.last_u < 1 - edge || row_.last_u > 1 + edge) {
      is_other_ = true;
      return false;
    }
    if (!rows_.empty() && row_.pixels != width_) is_other_ = true;
    width_ = row_.pixels;
    // the slope of a line through u over columns
    const double middle = (count - 1) / 2,
                 slope = (row_.column_u - middle * row_.u) / (count * (count * count - 1) / 12);
    without_last_ += std::fabs(slope * (count - 1) - 1) < std::fabs(slope * count - 1) ? 1 : -1;
    rows_.push_back(row_.v / count);
    return rows_.size() > 2 && find_height();
  }

  /// From the distance of rows, once that is known well enough in spite of the jitter.
  bool find_height() {
    const auto count = static_cast<double>(rows_.size());
    double sum = 0, row_sum = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) sum += rows_[k], row_sum += static_cast<double>(k) * rows_[k];
    const double spread = count * (count * count - 1) / 12, slope = (row_sum - (count - 1) / 2 * sum) / spread;
    if (slope == 0) return false;
    const double height = std::fabs(1 / slope) + (without_last_ > 0 ? 1 : 0);
    const double jitter = 0.29 / std::sqrt(static_cast<double>(width_ * samples_));
    if (jitter / std::sqrt(spread) * height > 0.12) return false;
    height_ = std::lround(height);
    for (std::size_t k = 1; k < rows_.size(); ++k)
      is_other_ = is_other_ || std::fabs((rows_[k] - rows_[k - 1]) / slope - 1) > 0.2;
    if (aspect_ratio_ > 0 && std::fabs(static_cast<double>(width_) / height / aspect_ratio_ - 1) > 0.03)
      is_other_ = true;
    return !is_other_ && std::fabs(height - static_cast<double>(height_)) < 0.35;
  }

  long samples_ = 1, in_pixel_ = 0, rays_ = 0, width_ = 0, height_ = 0;
  double aspect_ratio_ = 0, u_ = 0, v_ = 0;
  Row row_;
  std::vector<double> rows_;  ///< v of complete rows
  int without_last_ = 0;      ///< above 0: u is divided by width - 1
  bool is_in_row_ = false, is_other_ = false;
};

}  // namespace tyndall_book

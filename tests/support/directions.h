#pragma once
#include "core/base/math.h"
#include "tests/support/statistics.h"

#include <vector>

/// Checks that directions are drawn with the density that they are said to have: counts the drawn ones in equal cells
/// of a cap, compares the counts with the density's integral over each cell, and judges them by chi-square.
namespace tyndall::test {

/// Directions around a unit axis; width: 1 - cosine of the widest, 2 is the whole sphere.
class CapCells {
 public:
  static constexpr int rings = 12, sectors = 12, cells = rings * sectors;

  CapCells(Vec3d axis, double width) : axis_(axis), basis_(basis_around(axis)), width_(width) {}

  /// The density's fraction of each cell, by a grid of points within it.
  template <class Density>
  std::vector<double> integrate(const Density& pdf, int points = 40) const {
    std::vector<double> fraction(cells);
    const double part = 2 * pi * width_ / (cells * points * points);
    for (int ring = 0; ring < rings * points; ++ring)
      for (int sector = 0; sector < sectors * points; ++sector) {
        const double x = width_ * (ring + 0.5) / (rings * points), azimuth = (sector + 0.5) / (sectors * points);
        fraction[cell(ring / points, sector / points)] += part * pdf(at(x, azimuth));
      }
    return fraction;
  }
  void count(Vec3d direction) {
    const double c = dot(direction, axis_);
    const Vec3d across = direction - c * axis_;
    const double x = dot(across, across) / (1 + std::max(c, -0.999999)) / width_;
    const double azimuth = std::atan2(dot(direction, basis_.t), dot(direction, basis_.s)) / (2 * pi);
    const int ring = static_cast<int>((c > 0 ? x : (1 - c) / width_) * rings);
    if (ring > rings) ++outside_;  // the last ring's edge is rounded
    const int sector = static_cast<int>((azimuth < 0 ? azimuth + 1 : azimuth) * sectors);
    ++counts_[cell(std::min(ring, rings - 1), std::min(sector, sectors - 1))];
  }
  /// Chi-square of the counted directions among `drawn` against the shares, as a normal deviate. Cells that expect
  /// few are put together.
  double deviate(const std::vector<double>& fraction, int drawn) const {
    double chi = 0, few_expected = 0, few_counted = 0;
    int freedom = -1;
    const auto add = [&](double counted, double expected) {
      chi += (counted - expected) * (counted - expected) / expected;
      ++freedom;
    };
    for (std::size_t i = 0; i < cells; ++i) {
      const double expected = fraction[i] * drawn;
      if (expected >= 20) {
        add(counts_[i], expected);
      } else {
        few_expected += expected, few_counted += counts_[i];
      }
    }
    if (few_expected > 5 || few_counted > 5) add(few_counted, std::max(few_expected, 1.0));
    return deviate_of(chi, freedom);
  }
  int outside() const { return outside_; }

 private:
  static std::size_t cell(int ring, int sector) { return static_cast<std::size_t>(ring * sectors + sector); }
  Vec3d at(double x, double azimuth) const {
    const double sine = std::sqrt(x * (2 - x)), angle = 2 * pi * azimuth;
    return (1 - x) * axis_ + sine * (std::cos(angle) * basis_.s + std::sin(angle) * basis_.t);
  }

  Vec3d axis_;
  Basis<double> basis_;
  double width_;
  std::vector<int> counts_ = std::vector<int>(cells);
  int outside_ = 0;
};

inline double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

}  // namespace tyndall::test

#pragma once
#include <algorithm>

namespace tyndall::test {

/// Fraction of the light that metal does not absorb, at a cosine of incidence in [0, 1]: the fraction of the ball of
/// random points that is above the surface, a plane at distance c = cosine / fuzz from its centre: 1/2 + 3/4 (c -
/// c³/3).
inline double metal_survival(double fuzz, double cosine) {
  const double c = std::min(cosine / std::max(fuzz, 1e-9), 1.0);
  return 0.5 + 0.75 * (c - c * c * c / 3);
}

}  // namespace tyndall::test

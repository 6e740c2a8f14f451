#pragma once
#include "app/curves/curve.h"

#include <string>

/// Curves of error over time whose noise and bias are known.
namespace tyndall::test {

/// A curve whose error is noise / spp + bias, at 1 ms a sample, for 1 to 4096 samples a pixel.
inline ErrorCurve curve(const std::string& name, double noise, double bias) {
  ErrorCurve curve{name, {}};
  for (std::uint32_t spp = 1; spp <= 4096; spp *= 2)
    curve.points.push_back({1e-3 * spp, noise / spp + bias, spp, noise / spp});
  return curve;
}

inline constexpr double reference_noise = 1e-6;

}  // namespace tyndall::test

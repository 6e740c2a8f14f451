#pragma once
#include "core/specular/specular_path.h"

#include <algorithm>
#include <cmath>

/// Spheres that light passes, on their own, and how many paths there are between two points beside them.
namespace tyndall::test {

/// A unit sphere of glass, hollow if `inner_radius` is not 0.
template <class F>
SpecularSphere<F> sphere_of(double index, double inner_radius) {
  SpecularSphere<F> b{};
  b.radius = F(1), b.index = F(index), b.inner_radius = F(inner_radius), b.inner_index = F(1);
  b.mirror = false, b.hollow = inner_radius > 0, b.overlapped = false;
  return b;
}

template <class F>
Deflection<F> deflection_between(const SpecularSphere<F>& b, const EventSequence<F>& sequence, F near, F far,
                                 EndSigns<F> sign = {F(1), F(1)}) {
  SpecularPairs view{};
  view.shells = b.hollow;
  return deflection_of(view, b, ends_of(b, near, far), sequence, sign);
}

/// The deflection itself, term by term.
inline double deflection_there(const Deflection<double>& deflection, double s) {
  double sum = 0;
  for (int i = 0; i < deflection.terms; ++i)
    sum += deflection.times[i] * std::acos(std::min(1.0, deflection.maximum * (1 - s * s) * deflection.inverse[i]));
  return sum;
}

/// The number of paths, found by a slow search: counts how often the deflection passes `angle` or its negative, plus
/// any number of revolutions, from one of many places of s to the next.
inline int roots_by_search(const Deflection<double>& deflection, double angle, double end, int places) {
  const double first = static_cast<double>(min_parameter);
  int count = 0;
  for (const double sign : {1.0, -1.0}) {
    double last = 0;
    for (int i = 0; i <= places; ++i) {
      const double s = first + (end - first) * i / places;
      const double whole = std::floor((deflection_there(deflection, s) - sign * angle) / (2 * pi));
      if (i > 0) count += static_cast<int>(std::abs(whole - last));
      last = whole;
    }
  }
  return count;
}

}  // namespace tyndall::test

#pragma once
#include "maths.h"

#include <utility>

namespace tyndall_book {

/// Follows the sums that a loop adds the colours of its rays to: `pixel += ray_color(r, world, depth)`. Where a ray
/// goes into another sum, or into one that has been set anew, its pixel is another one.
class SumFollower {
 public:
  enum Step { none, first, same, other };

  /// Told before `added` is added to `sum`.
  void take(const vec3& sum, const vec3& added) { newest_ = {&sum, sum, sum + added}; }
  void reset() { newest_ = pixel_ = Sum(); }

  /// Ends a ray: what it was to the pixel of the rays before it. none: nothing was added.
  Step end_ray() {
    const Sum ray = std::exchange(newest_, Sum());
    if (!ray.where) return none;
    const bool goes_on = ray.where == pixel_.where && (ray.before - pixel_.after).length_squared() == 0;
    const Step step = !pixel_.where ? first : goes_on ? same : other;
    total_ = pixel_.after - pixel_.before;
    if (step != same) pixel_.where = ray.where, pixel_.before = ray.before;
    pixel_.after = ray.after;
    return step;
  }
  /// Of the pixel so far.
  vec3 total() const { return pixel_.after - pixel_.before; }
  /// Of the pixel without the newest ray.
  vec3 total_before() const { return total_; }

 private:
  struct Sum {
    const void* where = nullptr;
    vec3 before, after;
  };
  Sum newest_, pixel_;
  vec3 total_;
};

}  // namespace tyndall_book

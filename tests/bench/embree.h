#pragma once
#include "core/targets/kernels.h"

#include <memory>
#include <vector>

/// Closest hits by Embree 3, to compare with; optional when this is built.
namespace tyndall::bench {

/// Its version; empty: built without it.
const char* embree_version();

/// Spheres in Embree's own geometry, in a tree of its best quality. Without Embree it hits nothing.
class Embree {
 public:
  explicit Embree(const Spheres& spheres);
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  enum class Width { one, sixteen, sixteen_coherent };
  /// Closest hits of the rays, in groups of that width in the given order. hits: one a ray; the element is the index of
  /// the sphere.
  void trace(Width width, const std::vector<TraceRay>& rays, std::vector<TraceHit>& hits) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall::bench

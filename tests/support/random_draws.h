#pragma once
#include "core/base/vec.h"

#include <random>

/// Random numbers for scenes that are a pure function of a seed, the same with every standard library.
namespace tyndall::test {

class RandomDraws {
 public:
  explicit RandomDraws(unsigned seed) : engine_(seed) {}

  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32; }
  bool chance(double probability) { return between(0, 1) < probability; }
  /// 0 ... count - 1.
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  /// A colour of a surface, in [0.1, 0.95).
  Vec3d colour() {
    const double red = between(0.1, 0.95), green = between(0.1, 0.95);
    return {red, green, between(0.1, 0.95)};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace tyndall::test

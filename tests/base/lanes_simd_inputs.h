#pragma once
#include "core/base/lanes_simd.h"
#include "core/base/random.h"

/// What the checks of lanes_simd_check.h are made of: inputs, and a count of differences. Wide, the number type that is
/// checked, is defined before this is included.
namespace tyndall::test {
namespace {

inline constexpr int width = lanes_of<Wide>;

/// Inputs with every kind of number that a kernel can meet.
const float special_numbers[] = {0.0f,  -0.0f,   1.0f,    -1.0f,    0.5f,    -2.5f, 1e-38f, -1e30f,
                                 1e20f, 3.7e-5f, 8388607, 16777216, -123.4f, 2.0f,  0.3f,   __builtin_inff()};

[[maybe_unused]] float number(int i) {
  const std::uint32_t h = hash(static_cast<std::uint32_t>(i) * 3u + 1u);
  if (h % 4u == 0) return special_numbers[h / 4u % 16u];
  return (unit_interval<float>(h) - 0.5f) * (h % 4u == 1 ? 4.0f : 1000.0f);
}

/// Counts lanes in which something differs from what one path at a time would do.
struct Differences {
  int count = 0;
  void expect(const float* wide, const float* plain) {
    for (int k = 0; k < width; ++k)
      count += float_bits(wide[k]) != float_bits(plain[k]) && !(wide[k] != wide[k] && plain[k] != plain[k]);
  }
  void expect(const std::int32_t* wide, const std::int32_t* plain) {
    for (int k = 0; k < width; ++k) count += wide[k] != plain[k];
  }
  void expect(std::uint32_t wide, const bool* plain) {
    for (int k = 0; k < width; ++k) count += (wide >> k & 1u) != (plain[k] ? 1u : 0u);
    if constexpr (width < 32) count += wide >> width != 0;
  }
};

/// Inputs of one round: three groups of floats and two of whole numbers.
struct Inputs {
  float a[width], b[width], c[width];
  std::int32_t i[width], j[width];
  bool m[width], n[width];
  explicit Inputs(int round) {
    for (int k = 0; k < width; ++k) {
      const int at = 7 * (round * width + k);
      a[k] = number(at), b[k] = number(at + 1), c[k] = number(at + 2);
      i[k] = as_int(hash(static_cast<std::uint32_t>(at + 3)));
      j[k] = k % 3 ? i[k] : as_int(hash(static_cast<std::uint32_t>(at + 4)));  // often equal
      if (round % 2) i[k] %= 100, j[k] %= 100;
      m[k] = at % 3 == 1, n[k] = at % 5 < 2;
    }
  }
};

}  // namespace
}  // namespace tyndall::test

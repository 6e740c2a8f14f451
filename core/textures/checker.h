#pragma once
#include "core/base/fields.h"
#include "core/base/vec.h"
#include "core/textures/point.h"

#include <tuple>

/// Checker patterns: what users set, and their colour at a point.
namespace tyndall {

/// Cubes of two colours that fill space.
template <class F = double>
struct Checker {
  static constexpr const char* type = "checker";
  static constexpr const char* about =
      "Cubes of two colours in space: floor(position / scale) summed over the axes, even or odd.";
  F scale = F(1);
  Vec3<F> even{F(0), F(0), F(0)}, odd{F(1), F(1), F(1)};
  bool operator==(const Checker&) const = default;
};

template <class F>
constexpr auto fields(const Checker<F>*) {
  return std::tuple{
      Field{"scale", &Checker<F>::scale, above(0), Slider{0.01, 10, true}, "", "edge of a cube, scene units", true}
          .also("texture scale, frequency, tiling"),
      Field{"even", &Checker<F>::even, between(0, 1), Slider{0, 1}, "", "colour of the even cubes, linear RGB", true}
          .called("Even cubes")
          .also("checker color, checkerboard"),
      Field{"odd", &Checker<F>::odd, between(0, 1), Slider{0, 1}, "", "colour of the odd cubes, linear RGB", true}
          .called("Odd cubes")
          .also("second checker color")};
}

/// True in odd cubes. cell: position / scale.
template <class F>
TYNDALL_INLINE MaskOf<F> checker_odd(Vec3<F> cell) {
  const F sum = floor(cell.x) + floor(cell.y) + floor(cell.z);
  const F half = F(0.5f) * sum;
  return less(floor(half), half);
}

template <class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_at(const Checker<F>*, const auto& columns, const TexturePoint<F, Uv>& at) {
  return select(checker_odd(at.scaled), splat<F>(columns.b), splat<F>(columns.a));
}

}  // namespace tyndall

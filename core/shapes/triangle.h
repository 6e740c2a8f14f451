#pragma once
#include "core/base/fields.h"
#include "core/base/vec.h"

#include <tuple>

/// Triangles: what users set. outline.h tells where rays hit one.
namespace tyndall {

/// A triangle: corner + a u + b v, a and b >= 0, a + b <= 1. The normal is along u × v.
template <class F = double>
struct Triangle {
  static constexpr const char* type = "triangle";
  static constexpr const char* about = "A triangle: corner + a * u + b * v for a, b >= 0 and a + b <= 1.";
  Vec3<F> corner, u{F(1), F(0), F(0)}, v{F(0), F(1), F(0)};
  bool operator==(const Triangle&) const = default;
};

template <class F>
constexpr auto fields(const Triangle<F>*) {
  return std::tuple{
      Field{"corner", &Triangle<F>::corner, any_number(), no_slider(), "", "scene units", true}.also("quad position"),
      Field{"u", &Triangle<F>::u, any_number(), no_slider(), "", "edge from the corner, scene units", true}
          .called("Edge u")
          .also("quad width"),
      Field{"v", &Triangle<F>::v, any_number(), no_slider(), "", "other edge from the corner, scene units", true}
          .called("Edge v")
          .also("quad height")};
}

}  // namespace tyndall

#pragma once
#include "core/base/fields.h"
#include "core/base/vec.h"

#include <tuple>

/// Disks and rings: what users set. outline.h tells where rays hit one.
namespace tyndall {

/// A disk, ellipse or ring: center + a u + b v, inner <= sqrt(a² + b²) <= 1. The normal is along u × v.
template <class F = double>
struct Disk {
  static constexpr const char* type = "disk";
  static constexpr const char* about =
      "A disk, an ellipse or a ring: center + a * u + b * v, where inner <= sqrt(a^2 + b^2) <= 1.";
  Vec3<F> center, u{F(1), F(0), F(0)}, v{F(0), F(1), F(0)};
  F inner = F(0);
  bool operator==(const Disk&) const = default;
};

template <class F>
constexpr auto fields(const Disk<F>*) {
  return std::tuple{Field{"center", &Disk<F>::center, any_number(), no_slider(), "", "centre, scene units", true}
                        .called("Centre")
                        .also("ball center, ball centre, object position"),
                    Field{"u", &Disk<F>::u, any_number(), no_slider(), "", "first half axis, scene units", true}
                        .called("Edge u")
                        .also("quad width"),
                    Field{"v", &Disk<F>::v, any_number(), no_slider(), "", "second half axis, scene units", true}
                        .called("Edge v")
                        .also("quad height"),
                    Field{"inner", &Disk<F>::inner, Valid{.low = 0, .high = 1, .high_open = true}, Slider{0, 0.99}, "",
                          "radius of the hole over that of the rim; 0: no hole"}
                        .called("Hole")
                        .also("inner radius, ring width")};
}

}  // namespace tyndall

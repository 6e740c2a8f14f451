#pragma once
#include "core/base/fields.h"
#include "core/base/vec.h"
#include "core/textures/point.h"

#include <tuple>

/// Single colours as textures.
namespace tyndall {

/// One colour, under a name that several materials can share.
template <class F = double>
struct Solid {
  static constexpr const char* type = "solid";
  static constexpr const char* about = "One colour under a name that several materials can share.";
  Vec3<F> color{F(1), F(1), F(1)};
  bool operator==(const Solid&) const = default;
};

template <class F>
constexpr auto fields(const Solid<F>*) {
  return std::tuple{
      Field{"color", &Solid<F>::color, between(0, 1), Slider{0, 1}, "", "linear RGB", true}.called("Colour").also(
          "texture color, texture colour")};
}

template <class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_at(const Solid<F>*, const auto& columns, const TexturePoint<F, Uv>&) {
  return splat<F>(columns.a);
}

}  // namespace tyndall

#pragma once
#include "core/base/fields.h"
#include "core/base/vec.h"

#include <tuple>

namespace tyndall {

/// One colour, under a name that several materials can share.
template <class F = double>
struct Solid {
  static constexpr const char* type = "solid";
  Vec3<F> color{F(1), F(1), F(1)};
  bool operator==(const Solid&) const = default;
};

template <class F>
constexpr auto fields(const Solid<F>*) {
  return std::tuple{Field{"color", &Solid<F>::color, between(0, 1), Slider{0, 1}, "", "linear RGB", true}};
}

}  // namespace tyndall

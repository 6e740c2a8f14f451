#pragma once
#include "core/base/fields.h"
#include "core/materials/bsdf.h"

#include <tuple>

/// Lights: the material that shines. Its radiance is the material's colour.
namespace tyndall {

/// A light: sends its radiance (W/(m² sr), linear Rec.709) from both sides, the same in all directions; reflects
/// nothing.
template <class F = double>
struct Light {
  static constexpr const char* type = "light";
  static constexpr const char* about = "Shines on both sides, reflects nothing.";
  static constexpr const char* feature = "lights";  ///< its name among the needs of a scene
  static constexpr const char* colour_name = "radiance";
  static constexpr BsdfTraits traits{.emits = true, .constant_weight = true};
  bool operator==(const Light&) const = default;
};

template <class F>
constexpr auto fields(const Light<F>*) {
  return std::tuple{};
}

/// Absorbs every path: a light reflects nothing.
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const Light<F>&, const Incident<F>& in) {
  return {in.facing, F(1.0f), F(one_direction), {less(F(0.0f), F(1.0f)), less(F(1.0f), F(0.0f))}};
}

}  // namespace tyndall

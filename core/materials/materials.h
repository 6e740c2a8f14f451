#pragma once
#include "core/materials/dielectric.h"
#include "core/materials/lambertian.h"
#include "core/materials/light.h"
#include "core/materials/metal.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <variant>

/// The list of materials: what scene files, panels and kernels know of.
namespace tyndall {

/// Every material there is. To add one: write its header (copy the one that is most alike), name it here, test it.
template <class F>
using MaterialKinds = std::variant<Lambertian<F>, Metal<F>, Dielectric<F>, Light<F>>;

/// Key of the material's colour in scene files ("albedo", "radiance"); null: the kind has no colour.
template <class... Kinds>
constexpr const char* colour_name(const std::variant<Kinds...>& kind) {
  return std::visit([](const auto& k) { return k.colour_name; }, kind);
}

/// Number of fields of a kind of material. Each must be a double, because kernels read them from columns of floats.
template <class Kind>
constexpr std::size_t count_scalars(const Kind*) {
  return std::apply(
      []<class... T>(const Field<Kind, T>&...) {
        static_assert((std::is_same_v<T, double> && ...), "a material's fields are scalars");
        return sizeof...(T);
      },
      fields_of<Kind>());
}
template <class... Kinds>
constexpr std::size_t most_scalars(const std::variant<Kinds...>*) {
  return std::max({count_scalars(static_cast<const Kinds*>(nullptr))...});
}
/// The most fields that a kind has.
inline constexpr std::size_t max_material_fields = most_scalars(static_cast<const MaterialKinds<double>*>(nullptr));

}  // namespace tyndall

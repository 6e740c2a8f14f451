#pragma once
#include "core/base/kinds.h"
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

/// What is true of all materials of this kind.
template <class... Kinds>
constexpr BsdfTraits traits_of(const std::variant<Kinds...>& kind) {
  return std::visit([](const auto& k) { return k.traits; }, kind);
}

/// lobe_width() of a material of any kind.
template <class... Kinds>
constexpr double lobe_width(const std::variant<Kinds...>& kind) {
  return std::visit([](const auto& k) { return lobe_width(k); }, kind);
}

/// Whether a material only reflects, into the mirror direction alone.
template <class... Kinds>
constexpr bool is_mirror(const std::variant<Kinds...>& kind) {
  return lobe_width(kind) == 0 && !traits_of(kind).transmissive;
}

/// Index of a material whose boundary exact specular paths go through, inside over outside; 0: it has none.
template <class... Kinds>
constexpr double boundary_index(const std::variant<Kinds...>& kind) {
  return std::visit(
      []<class Kind>(const Kind& k) {
        if constexpr (Kind::traits.smooth_boundary)
          return static_cast<double>(k.refractive_index);
        else
          return 0.0;
      },
      kind);
}

/// The place of the next material with a trait in a list, from `first` on; the list's length if there is none.
template <bool BsdfTraits::*trait, class... Kinds>
constexpr std::size_t next_with(const std::variant<Kinds...>*, std::size_t first) {
  constexpr bool has[] = {(Kinds::traits.*trait)...};
  while (first < sizeof...(Kinds) && !has[first]) ++first;
  return first;
}

/// Which lanes are at a material with a trait: has_trait<&BsdfTraits::diffuse>(kind). kind: places in the list; others,
/// such as -1, have no trait. Costs one comparison for each material of the list that has the trait.
template <bool BsdfTraits::*trait, class List = MaterialKinds<double>, std::size_t first = 0, class I>
TYNDALL_INLINE auto has_trait(I kind) {
  constexpr std::size_t here = next_with<trait>(static_cast<const List*>(nullptr), first);
  if constexpr (here == std::variant_size_v<List>) {
    return equal(I(0), I(1));
  } else {
    constexpr bool last = next_with<trait>(static_cast<const List*>(nullptr), here + 1) == std::variant_size_v<List>;
    const auto found = equal(kind, I(static_cast<std::int32_t>(here)));
    if constexpr (last)
      return found;
    else
      return mask_or(found, has_trait<trait, List, here + 1>(kind));
  }
}

/// Whether all materials of a list have a trait.
template <bool BsdfTraits::*trait, class... Kinds>
constexpr bool all_have(const std::variant<Kinds...>*) {
  return ((Kinds::traits.*trait) && ...);
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
/// The most fields that a kind has.
inline constexpr std::size_t max_material_fields = []<class... Kinds>(const std::variant<Kinds...>*) {
  return std::max({count_scalars(static_cast<const Kinds*>(nullptr))...});
}(static_cast<const MaterialKinds<double>*>(nullptr));

}  // namespace tyndall

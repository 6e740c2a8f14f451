#pragma once
#include "core/materials/dielectric.h"
#include "core/materials/lambertian.h"
#include "core/materials/light.h"
#include "core/materials/metal.h"

#include <variant>

namespace tyndall {

/// Every material there is. To add one: write its header, name it here, test it.
template <class F>
using MaterialKinds = std::variant<Lambertian<F>, Metal<F>, Dielectric<F>, Light<F>>;

inline constexpr int max_material_fields = 1;  ///< the most fields a kind has

}  // namespace tyndall

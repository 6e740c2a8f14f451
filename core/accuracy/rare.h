#pragma once
#include "core/accuracy/estimate.h"

#include <cstdint>

/// When to warn that an estimated error cannot be trusted.
namespace tyndall {

inline constexpr std::uint32_t min_rare_spp = 2;

/// Whether a picture is not converged, whatever its estimated error: few pixels, or none yet, have met light that only
/// rare paths carry. estimate: of the film; spp: samples that every pixel has; chance: see chance_of_caustics. False
/// below min_rare_spp, when there is no estimate.
bool has_rare_bright_paths(const ErrorEstimate& estimate, std::uint32_t spp, double chance);

/// The warning for users in that case.
inline constexpr const char* rare_bright_paths = "not converged: rare bright paths";

}  // namespace tyndall

#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"

#include <cstdint>

namespace tyndall {

/// Whether the picture is not converged whatever its estimated error says: light that only rare paths carry has been
/// met by few pixels, or by none yet. spp: of every pixel, both halves; chance: see chance_of_caustics. False before 8
/// samples, when every estimate is rough.
bool has_rare_bright_paths(const Film& film, std::uint32_t spp, double chance, Crew* crew = nullptr);

/// What is said then.
inline constexpr const char* rare_bright_paths = "not converged: rare bright paths";

}  // namespace tyndall

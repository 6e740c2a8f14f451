#include "core/render/rare.h"

#include "core/accuracy/estimate.h"

namespace tyndall {

bool has_rare_bright_paths(const Film& film, std::uint32_t spp, double chance, Crew* crew) {
  if (spp < 8) return false;  // too early to tell
  // From half a path a pixel on that meets the light the estimate was within a fifth of the error.
  return chance * spp < 0.5 || estimate_error(film, crew).rests_on_few_pixels;
}

}  // namespace tyndall

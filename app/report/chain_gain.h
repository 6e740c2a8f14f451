#pragma once
#include "core/scene/scene.h"

#include <string>

/// What exact chains cost and gain in a scene, against leaving their light to chance.
namespace tyndall {

struct ChainGain {
  bool measured = false;  ///< false: the scene has no chains
  double time = 1;        ///< of a sample, over that of scattering: median of the pairs
  double error = 1;       ///< squared, at equal time, over that of scattering: as the films estimate it
};

/// Renders the scene with and without chains in turns, in small and on one thread, for about two seconds. Where light
/// is found by rare chance, scattering's error is estimated too small and the gain is larger than this says.
ChainGain measure_chain_gain(Scene scene, const std::string& isa);

}  // namespace tyndall

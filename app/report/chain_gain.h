#pragma once
#include "core/scene/scene.h"

#include <string>

/// What exact chains cost and gain in a scene, against leaving their light to chance.
namespace tyndall {

struct ChainGain {
  bool measured = false;  ///< false: the scene has no chains
  double time = 1;        ///< time of a sample over that without chains; median over pairs of renders
  double error = 1;       ///< estimated squared error at equal time over that without chains
};

/// Renders the scene with and without chains in turns, as a small picture on one thread, for about two seconds. Where
/// chance seldom finds the light, the error without chains is estimated too small, and the true gain is larger.
ChainGain measure_chain_gain(Scene scene, const std::string& isa);

}  // namespace tyndall

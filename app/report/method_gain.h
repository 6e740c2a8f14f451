#pragma once
#include "core/scene/scene.h"

#include <string>

/// What a method of integrator mis costs and gains in a scene, against doing without it.
namespace tyndall {

struct MethodGain {
  bool measured = false;  ///< false: the scene does without it anyway
  double time = 1;        ///< time of a sample over that without the method; median over pairs of renders
  double error = 1;       ///< estimated squared error at equal time over that without the method
};

/// Exact chains, against leaving their light to chance. Renders the scene with and without them in turns, as a small
/// picture on one thread, for about two seconds. Where chance seldom finds the light, the error without chains is
/// estimated too small, and the true gain is larger.
MethodGain measure_chain_gain(Scene scene, const std::string& isa);

/// Sharing of second vertices between pixels, likewise.
MethodGain measure_sharing_gain(Scene scene, const std::string& isa);

}  // namespace tyndall

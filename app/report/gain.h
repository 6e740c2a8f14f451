#pragma once
#include "core/render/prepare.h"
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <string>

/// What is gained in a scene by a kernel that leaves out the models which it does not use, and by methods of integrator
/// mis.
namespace tyndall {

/// What a scene's own kernel gains over the one that holds every model.
struct KernelGain {
  std::string isa;
  double gain = 1;                  ///< speed over the full kernel's: median of the pairs
  double minimum = 1, maximum = 1;  ///< of the pairs
  int pairs = 0;                    ///< 0: the full kernel is the scene's own, nothing was measured
  bool same_picture = true;         ///< to the last bit
};

/// Renders the scene by both in turns, on one thread, for about two seconds. Where `kernels` render the scene with the
/// full kernel, nothing is rendered and the gain is 1.
KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels);

/// What a method of integrator mis costs and gains in a scene, against doing without it.
struct MethodGain {
  bool measured = false;  ///< false: the scene does without it anyway
  double time = 1;        ///< time of a sample over that without the method; median over pairs of renders
  double error = 1;       ///< estimated squared error at equal time over that without the method
};

/// Exact chains, against leaving their light to chance; both ways at smooth glass that the camera sees
/// (core/transport/splitting.h); sharing of second vertices between pixels.
enum class MisMethod { specular, splitting, sharing };
/// Renders the scene with and without the method in turns, as a small picture on one thread, for about two seconds.
/// Where chance seldom finds the light, the error without chains is estimated too small, and the true gain is larger.
MethodGain measure_method_gain(MisMethod method, Scene scene, const std::string& isa);

}  // namespace tyndall

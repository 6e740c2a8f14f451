#pragma once
#include "core/render/prepare.h"
#include "core/targets/kernels.h"

#include <string>

/// How much faster a kernel is that leaves out the models which a scene does not use.
namespace tyndall {

/// What a scene's own kernel gains over the one that holds every model.
struct KernelGain {
  std::string isa;
  double gain = 1;             ///< speed over the full kernel's: median of the pairs
  double least = 1, most = 1;  ///< of the pairs
  int pairs = 0;               ///< 0: the full kernel is the scene's own, nothing was measured
  bool same_picture = true;    ///< to the last bit
};

/// Renders the scene by both in turns, on one thread, for about two seconds. Where `kernels` render the scene with the
/// full kernel, nothing is rendered and the gain is 1.
KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels);

}  // namespace tyndall

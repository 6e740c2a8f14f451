#pragma once
#include "core/compile/render_scene.h"

#include <string>

namespace tyndall {

/// What a scene's own kernel gains over the one that holds every model.
struct KernelGain {
  std::string isa;
  double gain = 1;             ///< speed over the full kernel's: median of the pairs
  double least = 1, most = 1;  ///< of the pairs
  int pairs = 0;
  bool same_picture = true;  ///< to the last bit
};

/// Renders the scene by both in turns, on one thread, for about two seconds.
KernelGain measure_kernel_gain(const RenderScene& scene, const std::string& isa);

}  // namespace tyndall

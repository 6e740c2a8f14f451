// The kernel with every model for a wide instruction set; compiled once for each, see core/base/lanes_target.h.
#include "core/base/lanes_target.h"
#include "core/targets/entry.h"

namespace tyndall {

Kernels full_kernel(TargetIs<Target::TYNDALL_TARGET>) {
  return full_kernel_of<KernelLanes>(name_of(Target::TYNDALL_TARGET));
}

}  // namespace tyndall

// The kernels that leave models out, for an instruction set that most processors have; compiled once for each, see
// core/base/lanes_target.h.
#include "core/base/lanes_target.h"
#include "core/targets/entry.h"

namespace tyndall {

template <>
void add_kernel_sets<Target::TYNDALL_TARGET>(Kernels& kernels) {
  add_kernel_sets_of<KernelLanes>(kernels);
}

}  // namespace tyndall

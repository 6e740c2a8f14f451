// One path at a time, for any processor: the readable reference.
#include "core/kernel/entry.h"

namespace tyndall {

Kernels scalar_kernels() { return full_kernel_of<float>("scalar"); }

}  // namespace tyndall

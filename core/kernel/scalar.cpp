// One path at a time: the readable reference, for any processor.
#include "core/kernel/entry.h"

namespace tyndall {

Kernels scalar_kernels() { return full_kernel_of<float>("scalar"); }

}  // namespace tyndall

// One path at a time, for any processor: over float the readable reference; over double, which is slow, to show how
// much rounding changes in the others.
#include "core/kernel/entry.h"

namespace tyndall {

Kernels scalar_kernels() { return full_kernel_of<float>("scalar"); }
Kernels double_kernels() { return full_kernel_of<double>("double"); }

}  // namespace tyndall

// One path at a time over double, to show how much rounding changes in the others.
#include "core/targets/entry.h"

namespace tyndall {

Kernels double_kernels() { return full_kernel_of<double>("double"); }

}  // namespace tyndall

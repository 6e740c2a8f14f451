// One path at a time over double: shows how much the rounding of floats changes in the other kernels.
#include "core/targets/entry.h"

namespace tyndall {

Kernels double_kernels() { return full_kernel_of<double>("double"); }

}  // namespace tyndall

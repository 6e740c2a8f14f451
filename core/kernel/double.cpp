// The kernels over double, for any CPU: they show what rounding costs the others.
#include "core/kernel/entry.h"

namespace tyndall {

Kernels double_kernels() { return full_kernel_of<double>("double"); }

}  // namespace tyndall

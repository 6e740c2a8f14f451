#include "tests/support/double_kernels.h"

#include "core/targets/entry.h"

namespace tyndall::test {

Kernels double_kernels() { return full_kernel_of<double>("double"); }

}  // namespace tyndall::test

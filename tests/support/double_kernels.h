#pragma once
#include "core/targets/kernels.h"

namespace tyndall::test {

/// The full kernel over double, one path at a time: shows what rounding costs the kernels of the program. It reads the
/// same columns of floats and draws the same random numbers, but is slow. Its name is "double".
Kernels double_kernels();

}  // namespace tyndall::test

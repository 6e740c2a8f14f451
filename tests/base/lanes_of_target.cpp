// Compiled once for each wide instruction set of the build, see core/base/lanes_target.h.
#include "core/base/lanes_target.h"

namespace tyndall::test {
namespace {
using Wide = KernelLanes;
}
}  // namespace tyndall::test

#include "tests/base/lanes_simd_check.h"

namespace tyndall::test {
template <>
LanesReport lanes_report_for<Target::TYNDALL_TARGET>() {
  return lanes_report();
}
}  // namespace tyndall::test

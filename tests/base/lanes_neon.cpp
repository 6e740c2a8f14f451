#include "core/base/lanes_simd.h"

namespace tyndall::test {
namespace {
using Wide = HWY_NAMESPACE::Floats;
}
}  // namespace tyndall::test

#include "tests/base/lanes_simd_check.h"

namespace tyndall::test {
LanesReport lanes_report_neon() { return lanes_report(); }
}  // namespace tyndall::test

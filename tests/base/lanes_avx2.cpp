#include "core/base/lanes_twice.h"

namespace tyndall::test {
namespace {
using Wide = Twice<HWY_NAMESPACE::Floats>;
}
}  // namespace tyndall::test

#include "tests/base/lanes_simd_check.h"

namespace tyndall::test {
LanesReport lanes_report_avx2() { return lanes_report(); }
}  // namespace tyndall::test

// The kernels for NEON, which every 64-bit ARM processor has: 4 lanes.
#include "core/base/lanes_simd.h"
#include "core/targets/entry.h"

namespace tyndall {

namespace {
using F = HWY_NAMESPACE::Floats;
static_assert(lanes_of<F> == 4, "the SIMD library fell back to a narrower set");
}  // namespace

Kernels neon_kernels() { return full_kernel_of<F>("neon"); }

}  // namespace tyndall

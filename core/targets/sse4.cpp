// The kernels for SSE4: 4 lanes. This file is compiled with flags that older CPUs cannot run, so it must contain
// nothing but the kernels.
#include "core/base/lanes_simd.h"
#include "core/targets/entry.h"

namespace tyndall {

namespace {
using F = HWY_NAMESPACE::Floats;
static_assert(lanes_of<F> == 4, "the SIMD library fell back to a narrower set: a flag is missing");
}  // namespace

Kernels sse4_kernels() { return full_kernel_of<F>("sse4"); }

}  // namespace tyndall

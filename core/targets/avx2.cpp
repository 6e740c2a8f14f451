// The kernels for AVX2: two groups of 8 lanes. This file is compiled with flags that older CPUs cannot run, so it must
// contain nothing but the kernels.
#include "core/base/lanes_twice.h"
#include "core/targets/entry.h"

namespace tyndall {

namespace {
using F = Twice<HWY_NAMESPACE::Floats>;
static_assert(lanes_of<F> == 16, "the SIMD library fell back to a narrower set: a flag is missing");
}  // namespace

Kernels avx2_kernels() { return with_kernel_sets<F>(avx2_full_kernel()); }

}  // namespace tyndall

// The kernels for AVX-512: two groups of 16 lanes. This file is compiled with flags that older CPUs cannot run, so it
// must contain nothing but the kernels.
#include "core/base/lanes_twice.h"
#include "core/targets/entry.h"

namespace tyndall {

namespace {
using F = Twice<HWY_NAMESPACE::Floats>;
static_assert(lanes_of<F> == 32, "the SIMD library fell back to a narrower set: a flag is missing");
}  // namespace

Kernels avx512_kernels() { return with_kernel_sets<F>(avx512_full_kernel()); }

}  // namespace tyndall

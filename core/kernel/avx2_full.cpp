// The kernels with chains for AVX2, apart from the others so that two processors can compile them: see avx2.cpp.
#include "core/base/lanes_twice.h"
#include "core/kernel/entry.h"

namespace tyndall {

namespace {
using F = Twice<HWY_NAMESPACE::Floats>;
static_assert(lanes_of<F> == 16, "the SIMD library fell back to a narrower set: a flag is missing");
}  // namespace

RenderUnit avx2_full_kernel() { return render_unit_entry<F, KernelSet::everything>; }
RenderUnit avx2_chains_kernel() { return render_unit_entry<F, KernelSet::chains_alone>; }

}  // namespace tyndall

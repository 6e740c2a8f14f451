// The filter for AVX2: 8 lanes. This file is compiled with flags that older CPUs cannot run, so it may contain nothing
// but the filter.
#include "core/base/lanes_simd.h"
#include "core/clean/filter_entry.h"

namespace tyndall::filter {

namespace {
using F = HWY_NAMESPACE::Floats;
static_assert(lanes_of<F> == 8, "the SIMD library fell back to a narrower set: a flag is missing");
}  // namespace

FilterSteps avx2_filter() { return filter_of<F>(); }

}  // namespace tyndall::filter

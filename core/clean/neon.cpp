// The filter for NEON, which every 64-bit ARM processor has: 4 lanes.
#include "core/base/lanes_simd.h"
#include "core/clean/filter_entry.h"

namespace tyndall::filter {

namespace {
using F = HWY_NAMESPACE::Floats;
static_assert(lanes_of<F> == 4, "the SIMD library fell back to a narrower set");
}  // namespace

FilterSteps neon_filter() { return filter_of<F>(); }

}  // namespace tyndall::filter

// Two groups of 8 lanes. Compiled with the flags of this instruction set: nothing but the kernels may be in here.
#include "core/base/lanes_twice.h"
#include "core/kernel/entry.h"

namespace tyndall {
namespace {
using F = Twice<HWY_NAMESPACE::Floats>;
static_assert(lanes_of<F> == 16, "the SIMD library fell back to a narrower set: a flag is missing");
void render(const SceneView& s, const Unit& u, double unit, FilmPixel* p, UnitCounts& c) {
  render_unit<F>(s, u, unit, p, c);
}
void trace(const SceneView& s, const TraceRay* r, TraceHit* h, int n, bool all) { trace_rays<F>(s, r, h, n, all); }
void first(const SceneView& s, const Region& r, FirstHit* h) { first_hits<F>(s, r, h); }
}  // namespace

Kernels avx2_kernels() { return {"avx2", lanes_of<F>, render, trace, first}; }

}  // namespace tyndall

// One path at a time: the readable reference, for any processor.
#include "core/kernel/entry.h"

namespace tyndall {
namespace {
void render(const SceneView& s, const Unit& u, double unit, FilmPixel* p, UnitCounts& c) {
  render_unit<float>(s, u, unit, p, c);
}
void trace(const SceneView& s, const TraceRay* r, TraceHit* h, int n, bool all) { trace_rays<float>(s, r, h, n, all); }
void first(const SceneView& s, const Region& r, FirstHit* h) { first_hits<float>(s, r, h); }
}  // namespace

Kernels scalar_kernels() { return {"scalar", 1, render, trace, first}; }

}  // namespace tyndall

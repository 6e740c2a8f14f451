// The same over double, for any processor: what rounding costs the others.
#include "core/kernel/entry.h"

namespace tyndall {
namespace {
void render(const SceneView& s, const Unit& u, double unit, FilmPixel* p, UnitCounts& c) {
  render_unit<double>(s, u, unit, p, c);
}
void trace(const SceneView& s, const TraceRay* r, TraceHit* h, int n, bool all) { trace_rays<double>(s, r, h, n, all); }
void first(const SceneView& s, const Region& r, FirstHit* h) { first_hits<double>(s, r, h); }
}  // namespace

Kernels double_kernels() { return {"double", 1, render, trace, first}; }

}  // namespace tyndall

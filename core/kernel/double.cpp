// The same over double, for any processor: what rounding costs the others.
#include "core/kernel/entry.h"

namespace tyndall {

Kernels double_kernels() {
  const RenderUnit render = render_unit_entry<double, KernelSet::everything>;
  return {"double", 1, {render, render, render}, trace_entry<double>, first_hits_entry<double>};
}

}  // namespace tyndall

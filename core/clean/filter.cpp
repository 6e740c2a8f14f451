// The filter for a wide instruction set; compiled once for each, see core/base/lanes_target.h.
#include "core/base/lanes_target.h"
#include "core/clean/judge.h"

namespace tyndall::filter {

template <>
FilterSteps filter_for<Target::TYNDALL_TARGET>() {
  return filter_of<TargetLanes>();
}

}  // namespace tyndall::filter

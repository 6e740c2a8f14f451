// One number at a time: the readable reference, for any processor.
#include "core/clean/filter_entry.h"

namespace tyndall::filter {

template <>
FilterSteps filter_for<Target::scalar>() {
  return filter_of<float>();
}

}  // namespace tyndall::filter

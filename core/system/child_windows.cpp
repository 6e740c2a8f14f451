#include "core/system/child.h"

#include <cerrno>

namespace tyndall {

bool runs_children() { return false; }

ChildEnd run_child(const ChildPlan&) {
  ChildEnd end;
  end.start_error = ENOSYS;
  return end;
}

}  // namespace tyndall

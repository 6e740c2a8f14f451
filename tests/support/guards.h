#pragma once
#include "core/system/guard.h"

#include <vector>

namespace tyndall {

/// Every layer alone, also as Linux 5.13, 5.19 and 6.2 have Landlock, and all together; as far as this system has them.
inline std::vector<GuardLayers> guards() {
  const GuardLayers& here = available_guard();
  std::vector<GuardLayers> all;
  if (here.namespaces) all.push_back({true, 0});
  for (int version = 1; version <= 3 && version < here.landlock; ++version) all.push_back({false, version});
  if (here.landlock > 0) all.push_back({false, here.landlock});
  if (here.namespaces && here.landlock > 0) all.push_back(here);
  return all;
}

}  // namespace tyndall

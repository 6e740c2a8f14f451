#pragma once
#include "core/base/lanes_twice.h"
#include "core/base/target.h"

/// The lanes of the instruction set that the including file is compiled for. CMake compiles some files once for each
/// wide set, with its flags and with TYNDALL_TARGET, its name among the Targets: `avx2`, for example. Older CPUs cannot
/// run them, so that they must contain nothing but what is called for that set alone.
namespace tyndall {

/// One register of lanes.
using TargetLanes = HWY_NAMESPACE::Floats;
static_assert(lanes_of<TargetLanes> == floats_in(Target::TYNDALL_TARGET),
              "the SIMD library fell back to a narrower set: a flag is missing");

/// What kernels compute with: two registers where they are wide, so that one computes while the other waits.
using KernelLanes = std::conditional_t<(lanes_of<TargetLanes> >= 8), Twice<TargetLanes>, TargetLanes>;

}  // namespace tyndall

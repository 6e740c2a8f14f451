#pragma once
#include "core/base/target.h"

/// What the tests of the lanes report. They are compiled once for each instruction set, with its flags.
namespace tyndall::test {

/// In how many lanes the wide operations of an instruction set did something else than those on float.
struct LanesReport {
  int lanes;
  int arithmetic, whole_numbers, masks, memory;
  float functions;  ///< largest distance of the elementary functions, in units of the errors that math.h promises
};

/// Of a wide target that this build has and this CPU can run.
template <Target>
LanesReport lanes_report_for();
template <>
LanesReport lanes_report_for<Target::sse4>();
template <>
LanesReport lanes_report_for<Target::avx2>();
template <>
LanesReport lanes_report_for<Target::avx512>();
template <>
LanesReport lanes_report_for<Target::neon>();

}  // namespace tyndall::test

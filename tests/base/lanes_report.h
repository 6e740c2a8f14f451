#pragma once

/// What the tests of the lanes report. They are compiled once for each instruction set, with its flags.
namespace tyndall::test {

/// In how many lanes the wide operations of an instruction set did something else than those on float.
struct LanesReport {
  int lanes;
  int arithmetic, whole_numbers, masks, memory;
  float functions;  ///< largest distance of the elementary functions, in units of the errors that math.h promises
};

// One per file that is compiled with its set's flags.
LanesReport lanes_report_sse4();
LanesReport lanes_report_avx2();
LanesReport lanes_report_avx512();
LanesReport lanes_report_neon();

}  // namespace tyndall::test

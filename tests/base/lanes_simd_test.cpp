#include "core/targets/kernels.h"
#include "tests/base/lanes_report.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::lanes_simd_test {

namespace {

[[maybe_unused]] void check_lanes(const char* isa, int lanes, test::LanesReport (*report_of)()) {
  if (!choose_kernels(isa)) {
    MESSAGE("not run on this CPU: ", std::string(isa));
    return;
  }
  const test::LanesReport report = report_of();
  CAPTURE(isa);
  CHECK(report.lanes == lanes);
  CHECK(report.lanes == choose_kernels(isa)->lanes);
  CHECK(report.arithmetic == 0);
  CHECK(report.whole_numbers == 0);
  CHECK(report.masks == 0);
  CHECK(report.memory == 0);
  CHECK(report.functions <= 2);  // float and lanes may each err by what the function promises
}

}  // namespace

TEST_CASE("lanes: every wide operation does what it does on float, lane by lane") {
#if defined(TYNDALL_HAVE_SSE4)
  check_lanes("sse4", 4, test::lanes_report_sse4);
#endif
#if defined(TYNDALL_HAVE_AVX2)
  check_lanes("avx2", 16, test::lanes_report_avx2);
#endif
#if defined(TYNDALL_HAVE_AVX512)
  check_lanes("avx512", 32, test::lanes_report_avx512);
#endif
#if defined(TYNDALL_HAVE_NEON)
  check_lanes("neon", 4, test::lanes_report_neon);
#endif
}

}  // namespace tyndall::test::lanes_simd_test

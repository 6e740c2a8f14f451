#include "core/targets/kernels.h"
#include "tests/base/lanes_report.h"

#include <doctest/doctest.h>

#include <string>
#include <tyndall_targets.h>

namespace tyndall::test::lanes_simd_test {

TEST_CASE("lanes: every wide operation does what it does on float, lane by lane") {
  for (const Target target : available_targets()) {
    if (target == Target::scalar) continue;
    const auto report = use_target<TYNDALL_BUILT_TARGETS>(target, [](auto built) -> LanesReport {
      if constexpr (built() == Target::scalar)
        return {};
      else
        return lanes_report_for<built()>();
    });
    CAPTURE(std::string(name_of(target)));
    CHECK(report.lanes == floats_in(target) * (floats_in(target) >= 8 ? 2 : 1));
    CHECK(report.lanes == choose_kernels(name_of(target))->lanes);
    CHECK(report.arithmetic == 0);
    CHECK(report.whole_numbers == 0);
    CHECK(report.masks == 0);
    CHECK(report.memory == 0);
    CHECK(report.functions <= 2);  // float and lanes may each err by what the function promises
  }
}

}  // namespace tyndall::test::lanes_simd_test

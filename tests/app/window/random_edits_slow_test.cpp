#include "tests/app/window/random_edits.h"
#include "tests/support/peak_memory.h"

#include <malloc.h>

#include <algorithm>

namespace tyndall::test::random_edits_slow_test {

TEST_CASE("12,000 random edits: the picture is that of the saved scene, and memory does not grow with them") {
  // Without a screen this process has 13 MB, and holes that edits leave in its heap come and go by up to 1.3 MB. So
  // these are medians over 2,000 edits, and may differ by 2 MB: 2.5 % of what a window has, and 200 bytes an edit,
  // where a scene that is kept takes thousands.
  std::vector<std::int64_t> early, late;
  check_random_edits("many_random_edits", 12000, 7, [&](int edits) {
    if (edits % 100 != 0 || edits < 1000 || (edits > 3000 && edits < 10000)) return;
    malloc_trim(0);
    (edits <= 3000 ? early : late).push_back(process_memory("VmRSS"));
  });
  const auto median = [](std::vector<std::int64_t> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
  };
  MESSAGE("kB after 1,000 edits: ", median(early) / 1000, ", after 10,000: ", median(late) / 1000);
  CHECK(median(late) - median(early) < 2e6);
}

}  // namespace tyndall::test::random_edits_slow_test

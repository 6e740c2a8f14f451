#include "tests/app/window/random_edits.h"

namespace tyndall::test::random_edits_test {

TEST_CASE("after many random edits with workers running the picture is that of the saved scene, bit for bit") {
  for (unsigned seed = 1; seed <= 8; ++seed) check_random_edits("random_edits", 300, seed, [](int) {});
}

}  // namespace tyndall::test::random_edits_test

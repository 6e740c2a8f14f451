#include "tests/app/window/random_edits.h"

#include <doctest/doctest.h>

namespace tyndall::test::random_edits_test {

TEST_CASE("after many random edits with workers running the picture is that of the saved scene, bit for bit") {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u})
    test::check_random_edits("random_edits", 300, seed, [](int) {});
}

}  // namespace tyndall::test::random_edits_test

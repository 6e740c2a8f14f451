#include "core/base/target.h"

#include "core/targets/kernels.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::target_test {

TEST_CASE("target: the list starts with scalar, grows in width and names each target once") {
  const std::vector<Target> list = available_targets();
  REQUIRE(!list.empty());
  CHECK(list.front() == Target::scalar);
  for (std::size_t i = 1; i < list.size(); ++i) CHECK(list[i - 1] < list[i]);
}

TEST_CASE("target: found by name, the widest without a name, and nothing for a name that does not exist") {
  for (const Target target : available_targets()) CHECK(find_target(name_of(target)) == target);
  CHECK(find_target("") == available_targets().back());
  CHECK_FALSE(find_target("avx1024"));
  CHECK_FALSE(find_target("SSE4"));
  CHECK_FALSE(find_target("double"));  // a way to compute for tests, not an instruction set
}

TEST_CASE("target: there are kernels for each of the available targets, of the same name and order") {
  const std::vector<Target> targets = available_targets();
  const std::vector<Kernels> kernels = available_kernels();
  REQUIRE(kernels.size() == targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    CHECK(std::string(kernels[i].isa) == name_of(targets[i]));
    CHECK(std::string(choose_kernels(name_of(targets[i]))->isa) == name_of(targets[i]));
  }
  CHECK(std::string(choose_kernels("")->isa) == name_of(targets.back()));
}

}  // namespace tyndall::test::target_test

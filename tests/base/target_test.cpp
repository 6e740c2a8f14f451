#include "core/base/target.h"

#include "core/targets/kernels.h"

#include <doctest/doctest.h>

#include <algorithm>
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
}

TEST_CASE("target: a missing one is not available, and what is expected in its place says how to build it") {
  const std::vector<Target> available = available_targets();
  for (const Target target : missing_targets()) {
    CHECK(std::find(available.begin(), available.end(), target) == available.end());
    CHECK(expected_targets(name_of(target)).find("TYNDALL_INSTRUCTION_SETS=all ./run") != std::string::npos);
  }
  CHECK(expected_targets("avx1024").find("TYNDALL_INSTRUCTION_SETS") == std::string::npos);
  for (const Target target : available) CHECK(expected_targets("x").find(name_of(target)) != std::string::npos);
  CHECK(slow_build_warning().empty() == (available.size() > 1 || missing_targets().empty()));
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

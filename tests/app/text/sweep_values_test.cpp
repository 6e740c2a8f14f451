#include "app/text/values.h"

#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::sweep_values_test {
using Values = std::vector<std::string>;

TEST_CASE("sweep: steps include both ends and are the numbers that a user would type") {
  CHECK(read_sweep_axis("/a/b=0:0.4:5").values == Values{"0", "0.1", "0.2", "0.3", "0.4"});
  CHECK(read_sweep_axis("/a/b=0:0.4:5").pointer == "/a/b");
  CHECK(read_sweep_axis("/a=-0.3:0.3:7").values == Values{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"});
  CHECK(read_sweep_axis("/a=2:1:2").values == Values{"2", "1"});
}

TEST_CASE("sweep: lists hold numbers, names and vectors") {
  CHECK(read_sweep_axis("/a=[0,0.1,5e-1]").values == Values{"0", "0.1", "0.5"});
  CHECK(read_sweep_axis("/a=[\"gold\", \"glass\"]").values == Values{"gold", "glass"});
  CHECK(read_sweep_axis("/a=gold,glass").values == Values{"gold", "glass"});
  CHECK(read_sweep_axis("/a=[gold,glass]").values == Values{"gold", "glass"});
  CHECK(read_sweep_axis("/a=[[0,1,2],[3,4,5]]").values == Values{"[0, 1, 2]", "[3, 4, 5]"});
}

TEST_CASE("sweep: what is no list of values is refused") {
  for (const char* text : {"", "a=1:2:3", "/a", "/a=", "/a=1", "/a=1:2", "/a=1:2:1", "/a=1:2:x", "/a=1:2:99999999",
                           "/a=1:1:3", "/a=[1]", "/a=gold,gold", "/a=gold,", "/a=nan:1:3", "/a=[]"})
    CHECK_THROWS_AS(read_sweep_axis(text), UsageError);
}

}  // namespace tyndall::test::sweep_values_test

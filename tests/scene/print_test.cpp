#include "core/scene/json_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace tyndall::test::print_test {

TEST_CASE("printed members: in their order, counts with all digits, null for what is no number") {
  JsonObject json;
  put(json, "name", "a \"b\"");
  put(json, "count", std::uint64_t{100000000000});
  put(json, "ratio", 0.25);
  put(json, "unknown", std::numeric_limits<double>::infinity());
  put(json, "nothing", std::optional<double>());
  put(json, "yes", true);
  put(json, "words", std::vector<std::string>{"a", "b"});
  put(json, "long", std::vector<int>(60, 12));
  const std::string text = print_members(json);
  CHECK(text.substr(0, text.find("\"long\"")) == R"({
  "name": "a \"b\"",
  "count": 100000000000,
  "ratio": 0.25,
  "unknown": null,
  "nothing": null,
  "yes": true,
  "words": ["a", "b"],
  )");
  CHECK(text.find("12, 12]\n}\n") != text.npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 10);  // a line for each member and each brace
}

}  // namespace tyndall::test::print_test

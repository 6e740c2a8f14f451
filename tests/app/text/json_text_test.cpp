#include "app/text/json_text.h"

#include <doctest/doctest.h>

#include <limits>

using namespace tyndall;

TEST_CASE("JSON text: members in their order, counts with all digits, null for what is no number") {
  JsonText json;
  json.add("name", "a \"b\" \xff");
  json.add("count", std::uint64_t{100000000000});
  json.add("ratio", 0.25);
  json.add("unknown", std::numeric_limits<double>::infinity());
  json.add("nothing", std::optional<double>());
  json.add("yes", true);
  json.add("words", std::vector<std::string>{"a", "b"});
  json.add_json("list", "[1, 2]");
  CHECK(json.contains("ratio"));
  CHECK_FALSE(json.contains("rat"));
  CHECK(json.text() == R"({
  "name": "a \"b\" \\xff",
  "count": 100000000000,
  "ratio": 0.25,
  "unknown": null,
  "nothing": null,
  "yes": true,
  "words": ["a", "b"],
  "list": [1, 2]
}
)");
}

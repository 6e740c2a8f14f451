#include "app/files/viewer_stream.h"

#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::viewer_stream_test {

TEST_CASE("viewers' addresses: hosts, ports, IPv6 with and without brackets") {
  const auto read = [](const std::string& text) { return text_of(read_viewer_address(text)); };
  CHECK(read("localhost") == "localhost:14158");
  CHECK(read("10.0.0.7:80") == "10.0.0.7:80");
  CHECK(read("[::1]:14158") == "[::1]:14158");
  CHECK(read("[fe80::1%eth0]") == "[fe80::1%eth0]:14158");
  CHECK(read("::1") == "[::1]:14158");
  for (const char* wrong :
       {"", ":1", "host:", "host:0", "host:65536", "host:-1", "host:1e3", "[::1", "[::1]1", "[]:1"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(read_viewer_address(wrong), UsageError);
  }
}

TEST_CASE("a viewer that was never there is a problem, once, and nothing waits for it") {
  ViewerStream stream({"127.0.0.1", "1"}, "picture", 4, 4);
  stream.finish(5);  // returns as soon as the connection is refused
  CHECK_FALSE(stream.ready());
  CHECK(stream.problem().value().starts_with("127.0.0.1:1: "));
  CHECK_FALSE(stream.problem());
}

}  // namespace tyndall::test::viewer_stream_test

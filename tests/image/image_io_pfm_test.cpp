#include "tests/support/picture_bytes.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

namespace tyndall::test::image_io_pfm_test {
namespace fs = std::filesystem;

namespace {

LinearImage small_image() { return {2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0.25f, 0.125f, 2, 7.5f, 1e-4f, 0, 0, 0}}; }

}  // namespace

TEST_CASE("pfm: header, bottom row first, exact values") {
  const fs::path file = scratch_folder("pfm") / "a.pfm";
  write_pfm(file, small_image());
  const std::string text = read_text(file);
  CHECK(text.substr(0, 12) == "PF\n2 3\n-1.0\n");
  REQUIRE(text.size() == 12 + 18 * 4);
  float first[3];
  std::memcpy(first, text.data() + 12, sizeof first);
  CHECK(first[0] == 2.0f);
  CHECK(first[1] == 7.5f);
  const LinearImage image = read_image(file);
  CHECK(image.width == 2);
  CHECK(image.height == 3);
  CHECK(image.rgb == small_image().rgb);
}

TEST_CASE("pfm: grey, big endian and other scales") {
  CHECK(light_of(std::string("Pf 1 2 1\n\x3f\x80\0\0\xc0\0\0\0", 17)) == std::vector<float>{-2, -2, -2, 1, 1, 1});
  CHECK(light_of(std::string("Pf\n1 1\n-2.5\n\0\0\x80\x3f", 16)) == std::vector<float>{2.5f, 2.5f, 2.5f});
}

TEST_CASE("pfm: damaged ones are refused") {
  for (const std::string text : {"PF\n", "PF\n2 2\n", "Pf\n1 1\n0\n1234", "Pf\n1 1\nnan\n1234", "Pf\n1 1\n-inf\n1234",
                                 "PF\n2 x\n-1\n", "PF\n2 2\n-1.0\n1234", "PF\n0 2\n-1.0\n", "PF\n-1 -1\n-1.0\n",
                                 "PF\n999999999 999999999\n-1.0\n", "PF\n2147483647 1\n-1.0\n"}) {
    CAPTURE(text);
    CHECK(message_for(text) != "");
  }
}

TEST_CASE("pfm: a header with CR LF does not move the numbers by a byte") {
  const std::string pixels("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
  const std::vector<float> values{1, 2, 3};
  for (const std::string header :
       {"PF\r\n1 1\r\n-1.0\r\n", "PF\r\n1 1\r\n-1.0\n", "PF\n1 1\n-1.0\r\n", "PF\n1 1\n-1.0\n"})
    CHECK(light_of(header + pixels) == values);
  // One character follows the header, and the first number begins with a line feed: nothing is left over.
  const std::string fed("\x0a\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
  CHECK(light_of("PF\n1 1\n-1.0\r" + fed)[1] == 2);
}

TEST_CASE("pfm: bytes after the last pixel are refused") {
  const std::string whole = "Pf\n1 1\n-1.0\n" + std::string("\0\0\x80\x3f", 4);
  CHECK(message_for(whole + "\n") == "");
  CHECK(message_for(whole + "abc") == "found 3 bytes after the last pixel, expected none");
  CHECK(message_for(whole + whole) == "found several pictures in one file, expected one");
}

}  // namespace tyndall::test::image_io_pfm_test

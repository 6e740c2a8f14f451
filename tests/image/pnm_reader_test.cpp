#include "core/image/pnm_reader.h"
#include "tests/support/picture_bytes.h"

#include <doctest/doctest.h>

#include <span>
#include <vector>

/// A picture that comes in pieces is the one in the file, wherever the pieces are cut.
namespace tyndall::test::pnm_reader_test {

namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// What comes of these pieces, one after the other.
struct Reading {
  PnmReader reader{"pipe"};
  std::vector<float> rgb{};

  explicit Reading(const std::vector<std::string>& pieces) {
    for (const std::string& piece : pieces) reader.take(bytes_of(piece), rgb);
    reader.end(rgb);
  }
};

std::string message_of(const std::vector<std::string>& pieces) {
  try {
    const Reading reading(pieces);
  } catch (const ImageFileError& error) {
    return error.what();
  }
  return "";
}

const std::vector<std::string>& pictures() {
  static const std::vector<std::string> all{
      "P3\n2 1\n255\n0 128 255\n10 20 30\n",
      "P3 # made by hand\n#\n2#wide\r\n1 255 0 128 255 10 20# the last\n30",
      "P3\r\n2 1\r\n255\r\n0\t128\v255\f10 20 30\r\n\r\n# the end\n",
      "P3 1 2 1000 +7 -3 2000 00 1000 5",
      "P2 2 1 255 7 9\n",
      std::string("P6\n2 1\n255\n\0\x80\xff\x0a\x14\x1e", 17),
      std::string("P6#x\n2 1 # y\n255#z\n\0#\xff\x0a\x14\x20", 25),
      std::string("P6\r\n2 1\r\n255\r\n\x0a\x80\xff\x0a\x14\x1e", 20),
      std::string("P6 1 1 65535\n\x80\0\x80\xff\0\xff", 19),
      "P5 2 1 255\n\x07\x09",
  };
  return all;
}

}  // namespace

TEST_CASE("pnm reader: the pieces may be cut anywhere") {
  for (const std::string& picture : pictures()) {
    CAPTURE(picture);
    const std::vector<float> expected = light_of(picture);
    for (std::size_t cut = 0; cut <= picture.size(); ++cut)
      for (std::size_t second = cut; second <= picture.size(); ++second) {
        const Reading reading({picture.substr(0, cut), picture.substr(cut, second - cut), picture.substr(second)});
        const bool same = reading.rgb == expected && reading.reader.whole();
        if (!same) FAIL_CHECK("cut at ", cut, " and ", second);
      }
    std::vector<std::string> letters;
    for (const char c : picture) letters.emplace_back(1, c);
    CHECK(Reading(letters).rgb == expected);
  }
}

TEST_CASE("pnm reader: the header is known as soon as it is there, pixels as soon as they are") {
  PnmReader reader("pipe");
  std::vector<float> rgb;
  reader.take(bytes_of("P3 3 2 25"), rgb);
  CHECK(reader.header() == nullptr);
  CHECK(reader.expected() == std::string("the largest number of a colour"));
  reader.take(bytes_of("5 "), rgb);
  REQUIRE(reader.header() != nullptr);
  CHECK(reader.header()->width == 3);
  CHECK(reader.header()->height == 2);
  CHECK(reader.header()->largest == 255);
  CHECK(rgb.empty());
  reader.take(bytes_of("0 255 25"), rgb);
  CHECK(rgb == std::vector<float>{0, 1});
  reader.take(bytes_of("5 255"), rgb);
  CHECK(rgb == std::vector<float>{0, 1, 1});
  reader.end(rgb);  // nothing can follow the last number any more
  CHECK(rgb == std::vector<float>{0, 1, 1, 1});
  CHECK_FALSE(reader.whole());
  CHECK_FALSE(reader.remark());
}

TEST_CASE("pnm reader: takes no more than the picture, and says what was outside of the range") {
  PnmReader reader("pipe");
  std::vector<float> rgb;
  CHECK(reader.take(bytes_of("P3 1 1 255 -1 5 999 "), rgb) == 20);
  CHECK(reader.whole());
  CHECK(reader.take(bytes_of("\n # x\n P3"), rgb) == 7);
  CHECK(reader.remark() ==
        "2 of 3 numbers are outside of 0 to 255 and are read as the nearest that is within; the first one, -1, is at "
        "x 0, y 0");
  PnmReader binary("pipe");
  CHECK(binary.take(bytes_of("P5 1 1 255 \n\n"), rgb) == 12);
}

TEST_CASE("pnm reader: what is damaged is told when it comes, wherever it is cut") {
  const std::string nan = "P3 1 1 255 1 nan 3";
  for (std::size_t cut = 0; cut <= nan.size(); ++cut)
    CHECK(message_of({nan.substr(0, cut), nan.substr(cut)}) ==
          "pipe: cannot read: damaged: found \"nan\", expected a colour, a whole number");
  CHECK(message_of({"P3 1 1 25", "5 1 2 ", "0", ".5"}) ==
        "pipe: cannot read: damaged: found \"0.5\", expected a colour, a whole number");
  CHECK(message_of({"P", "4 1"}) ==
        "pipe: cannot read: found a picture of the kind P4, expected P3 or P6 (colours), or P2 or P5 (greys)");
  CHECK(message_of({"Progress"}) ==
        "pipe: cannot read: found a picture of the kind Pr, expected P3 or P6 (colours), or P2 or P5 (greys)");
  CHECK(message_of({"P6 70000", " 70000", " 255\n"}) ==
        "pipe: cannot read: found an image of 70000 x 70000 pixels, expected 1 to 2^28 in all");
  CHECK(message_of({"P3 1 1 255 " + std::string(100, 'x')}).size() < 200);
}

}  // namespace tyndall::test::pnm_reader_test

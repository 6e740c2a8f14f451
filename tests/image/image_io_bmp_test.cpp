#include "tests/support/picture_bytes.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::image_io_bmp_test {
namespace fs = std::filesystem;

namespace {

std::string little(std::uint32_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  return bytes;
}

struct BmpForm {
  int width = 2, height = 2;  ///< height below 0: rows from the top
  std::uint32_t bits = 24, compression = 0, header = 40;
  std::string more{};     ///< of the header, after its first 40 bytes: masks, colour space
  std::string palette{};  ///< 4 bytes a colour; before it the masks that follow a header of 40 bytes
};
std::string bmp_bytes(const BmpForm& form, const std::string& rows) {
  std::string header = little(form.header, 4) + little(static_cast<std::uint32_t>(form.width), 4) +
                       little(static_cast<std::uint32_t>(form.height), 4) + little(1, 2) + little(form.bits, 2) +
                       little(form.compression, 4) + std::string(20, '\0') + form.more;
  header.resize(form.header);
  header += form.palette;
  const auto start = static_cast<std::uint32_t>(14 + header.size());
  return "BM" + little(start + static_cast<std::uint32_t>(rows.size()), 4) + little(0, 4) + little(start, 4) + header +
         rows;
}

PictureFile bmp(const BmpForm& form, const std::string& rows) { return picture_of(bmp_bytes(form, rows)); }
std::vector<std::uint8_t> bmp_numbers(const BmpForm& form, const std::string& rows) {
  return numbers_of(bmp_bytes(form, rows));
}

const std::string four_pixels("\1\2\3\4\5\6\0\0\7\x08\x09\x0a\x0b\x0c\0\0", 16);  // blue, green, red; rows of 8 bytes

struct TgaForm {
  std::uint32_t type = 2, width = 2, height = 2, bits = 24, descriptor = 0x20;
  std::string palette{};  ///< 3 bytes a colour
  std::uint32_t first_colour = 0;
};
std::string tga_bytes(const TgaForm& form, const std::string& pixels) {
  const bool mapped = !form.palette.empty();
  return little(0, 1) + little(mapped, 1) + little(form.type, 1) + little(form.first_colour, 2) +
         little(static_cast<std::uint32_t>(form.palette.size() / 3), 2) + little(mapped ? 24 : 0, 1) + little(0, 4) +
         little(form.width, 2) + little(form.height, 2) + little(form.bits, 1) + little(form.descriptor, 1) +
         form.palette + pixels;
}
PictureFile tga(const TgaForm& form, const std::string& pixels, const std::string& more = "") {
  return picture_of(tga_bytes(form, pixels) + more);
}
std::vector<std::uint8_t> tga_numbers(const TgaForm& form, const std::string& pixels) {
  return numbers_of(tga_bytes(form, pixels));
}

}  // namespace

// A 2 x 1 BMP and a 2 x 1 TGA of red and (64, 128, 192), and a grey TGA, byte by byte.
TEST_CASE("bmp and tga: byte by byte, without the helpers of the other tests") {
  const std::vector<std::uint8_t> expected = {255, 0, 0, 64, 128, 192};
  std::string bmp("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string("\0\0\xff\xc0\x80\x40\0\0", 8);
  CHECK(numbers_of(bmp) == expected);
  const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28\0\0\xff\xff\xc0\x80\x40\x10", 26);
  CHECK(numbers_of(tga) == expected);
  CHECK(picture_of(tga).image.width == 2);
  const std::string grey("\0\0\3\0\0\0\0\0\0\0\0\0\1\0\1\0\x08\x20\x55", 19);
  CHECK(numbers_of(grey) == std::vector<std::uint8_t>{0x55, 0x55, 0x55});
}

TEST_CASE("bmp: rows from the bottom and from the top") {
  CHECK(bmp_numbers({2, 2}, four_pixels) == std::vector<std::uint8_t>{9, 8, 7, 12, 11, 10, 3, 2, 1, 6, 5, 4});
  CHECK(bmp_numbers({2, -2}, four_pixels) == std::vector<std::uint8_t>{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10});
  CHECK(read_texture(picture_file(bmp_bytes({2, -2}, four_pixels))).image.height == 2);
}

TEST_CASE("bmp: palettes, 16 bits and bit fields") {
  const std::string palette("\0\0\0\0\xff\x80\x40\0", 8);
  CHECK(bmp_numbers({2, 1, 8, 0, 40, "", palette}, std::string("\1\0\0\0", 4)) ==
        std::vector<std::uint8_t>{0x40, 0x80, 0xff, 0, 0, 0});
  CHECK(bmp_numbers({2, 1, 4, 0, 40, "", palette}, std::string("\x10\0\0\0", 4)) ==
        std::vector<std::uint8_t>{0x40, 0x80, 0xff, 0, 0, 0});
  CHECK(bmp_numbers({2, -1, 1, 0, 40, "", palette}, std::string("\x80\0\0\0", 4)) ==
        std::vector<std::uint8_t>{0x40, 0x80, 0xff, 0, 0, 0});
  CHECK(bmp_numbers({2, 1, 16}, std::string("\0\x7c\x1f\0", 4)) == std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255});
  const std::string fields_565 = little(0xf800, 4) + little(0x07e0, 4) + little(0x001f, 4);
  CHECK(bmp_numbers({2, 1, 16, 3, 40, "", fields_565}, std::string("\xe0\x07\0\xf8", 4)) ==
        std::vector<std::uint8_t>{0, 255, 0, 255, 0, 0});
  const std::string fields_rgb = little(0xff, 4) + little(0xff00, 4) + little(0xff0000, 4) + little(0, 4);
  CHECK(bmp_numbers({1, 1, 32, 3, 108, fields_rgb}, "\1\2\3\4") == std::vector<std::uint8_t>{1, 2, 3});
}

TEST_CASE("bmp: alpha is known to be there, unless it is 0 everywhere") {
  CHECK(bmp({2, 1, 32}, "\1\2\3\x40\1\2\3\xff").has_alpha);
  CHECK_FALSE(bmp({2, 1, 32}, std::string("\1\2\3\0\1\2\3\0", 8)).has_alpha);
  CHECK_FALSE(bmp({2, 1, 32}, "\1\2\3\xff\1\2\3\xff").has_alpha);
}

TEST_CASE("bmp: kinds that are not read are refused by name") {
  CHECK(message_for(bmp_bytes({2, 1, 8, 1, 40, "", std::string(1024, '\0')}, std::string("\2\0\0\1", 4))) ==
        "found a BMP whose rows are run-length encoded (RLE), expected one that is not compressed");
  CHECK(message_for(bmp_bytes({2, 1, 4, 2, 40, "", std::string(64, '\0')}, std::string("\2\0\0\1", 4)))
            .starts_with("found a BMP whose rows are run-length encoded"));
  CHECK(message_for(bmp_bytes({2, 2, 24, 5}, four_pixels)) ==
        "found a BMP of compression 5, expected none or bit fields");
  CHECK(message_for(bmp_bytes({2, 1, 64}, std::string(16, '\0'))) ==
        "found a BMP of 64 bits a pixel, expected 1, 4, 8, 16, 24 or 32");
  CHECK(message_for(bmp_bytes({1, 1, 32, 3, 56, std::string(16, '\1')}, "\1\2\3\4")) ==
        "found a BMP with bit fields in a header of 56 bytes, expected 40, 108 or 124");
  const std::string os2 = "BM" + little(38, 4) + little(0, 4) + little(32, 4) + little(12, 4) + little(1, 2) +
                          little(1, 2) + little(1, 2) + little(8, 2) + std::string("\0\0\0\xff\xff\xff\1\0\0\0", 10);
  CHECK(message_for(os2) == "found a BMP of OS/2 with a palette, expected a header of 40 bytes or more");
}

TEST_CASE("bmp: what is cut off or beyond its palette is refused, not taken for black") {
  CHECK(message_for(bmp_bytes({2, 2}, four_pixels.substr(0, 13))) ==
        "damaged: found 67 bytes, expected at least 68 for the size that it says");
  CHECK(message_for(bmp_bytes({2, 2}, four_pixels.substr(0, 14))) == "");  // without the last row's padding
  CHECK(message_for(bmp_bytes({2, 1, 8, 0, 40, "", std::string(8, '\0')}, std::string("\2\0\0\0", 4))) ==
        "damaged: found colour 2, expected one of the palette's 2");
  CHECK(message_for(bmp_bytes({2, std::numeric_limits<int>::min()}, four_pixels))
            .starts_with("found an image of 2 x 2147483648 pixels"));
  CHECK(message_for(bmp_bytes({-2, 2}, four_pixels)).starts_with("found an image of -2 x 2 pixels"));
}

TEST_CASE("bmp: a colour space that is not sRGB is told") {
  const auto remarks = [](const std::string& space, std::uint32_t size = 108) {
    return bmp({2, 2, 24, 0, size, std::string(16, '\0') + space}, four_pixels).remarks.size();
  };
  const auto calibrated = [](std::uint32_t green_y, std::uint32_t gamma) {
    std::string space = little(0, 4);
    for (const std::uint32_t v : {64u, 33u, 3u, 30u, green_y, 10u, 15u, 6u, 79u})
      space += little(static_cast<std::uint32_t>(v / 100.0 * 1073741824.0), 4);
    for (int i = 0; i < 3; ++i) space += little(gamma, 4);
    return space;
  };
  CHECK(remarks("BGRs") == 0);
  CHECK(remarks(" niW") == 0);
  CHECK(remarks(little(0, 4)) == 0);
  CHECK(remarks(calibrated(60, 144180)) == 0);  // 2.2
  CHECK(remarks(calibrated(60, 65536)) == 1);
  CHECK(remarks(calibrated(70, 144180)) == 1);
  CHECK(remarks("KNIL", 124) == 1);
  CHECK(remarks("DEBM", 124) == 1);
}

TEST_CASE("tga: rows from the bottom, the top and the right") {
  const std::string pixels("\1\1\1\2\2\2\3\3\3\4\4\4", 12);
  const auto order = [&](std::uint32_t descriptor) {
    const std::vector<std::uint8_t> numbers = tga_numbers({2, 2, 2, 24, descriptor}, pixels);
    return std::vector<int>{numbers[0], numbers[3], numbers[6], numbers[9]};
  };
  CHECK(order(0x20) == std::vector{1, 2, 3, 4});
  CHECK(order(0x00) == std::vector{3, 4, 1, 2});
  CHECK(order(0x30) == std::vector{2, 1, 4, 3});
  CHECK(order(0x10) == std::vector{4, 3, 2, 1});
}

TEST_CASE("tga: runs, palettes and 16 bits") {
  CHECK(tga_numbers({10, 2, 2}, "\x82\1\2\3" + std::string("\0\4\5\6", 4)) ==
        std::vector<std::uint8_t>{3, 2, 1, 3, 2, 1, 3, 2, 1, 6, 5, 4});
  CHECK(tga_numbers({1, 2, 1, 8, 0x20, std::string("\1\2\3\4\5\6", 6)}, std::string("\1\0", 2)) ==
        std::vector<std::uint8_t>{6, 5, 4, 3, 2, 1});
  CHECK(tga_numbers({2, 1, 1, 16}, std::string("\0\x7c", 2)) == std::vector<std::uint8_t>{255, 0, 0});
}

TEST_CASE("bmp and tga: fields that mean nothing here change nothing") {
  std::string tga = tga_bytes({2, 1, 1}, "\1\2\3");
  tga[8] = 5, tga[10] = 7;  // place on the screen
  tga[0] = 4, tga.insert(18, "text");
  CHECK(numbers_of(tga) == std::vector<std::uint8_t>{3, 2, 1});
  std::string bmp = bmp_bytes({2, 2}, four_pixels);
  bmp[38] = 99, bmp[42] = 99, bmp[50] = 9;  // resolution, important colours
  CHECK(numbers_of(bmp) == numbers_of(bmp_bytes({2, 2}, four_pixels)));
}

TEST_CASE("tga: kinds that are not read, and damage, are refused by name") {
  const std::string pixels(12, '\1'), palette("\1\2\3\4\5\6", 6);
  CHECK(message_for(tga_bytes({2, 2, 2, 24, 0xa0}, pixels)) ==
        "found a TGA with interleaved rows, expected one row after the other");
  CHECK(message_for(tga_bytes({2, 2, 2, 24, 0x20, palette}, pixels)) ==
        "found a TGA with a palette that its pixels do not use");
  CHECK(message_for(tga_bytes({1, 2, 1, 8, 0x20, palette, 3}, std::string("\3\4", 2))) ==
        "found a TGA whose palette begins with colour 3, expected colour 0");
  CHECK(message_for(tga_bytes({1, 2, 1, 8, 0x20, palette}, std::string("\1\2", 2))) ==
        "damaged: found colour 2, expected one of the palette's 2");
  CHECK(message_for(tga_bytes({}, pixels.substr(0, 11))) == "damaged: the TGA ends in the middle");
  CHECK(message_for(tga_bytes({10}, "\x82\1\2\3")) == "damaged: the TGA ends in the middle");
  CHECK(message_for(tga_bytes({10}, "\x84\1\2\3")) == "damaged: a run of the TGA does not fit");
  CHECK(message_for(tga_bytes({2, 65535, 65535}, pixels)).starts_with("found an image of 65535 x 65535 pixels"));
}

TEST_CASE("tga: alpha, gamma and multiplied colours are told") {
  const std::string pixels("\1\2\3\x40\1\2\3\xff", 8);
  const TgaForm form{2, 2, 1, 32, 0x28};
  CHECK(tga(form, pixels).has_alpha);
  CHECK_FALSE(tga(form, std::string("\1\2\3\0\1\2\3\0", 8)).has_alpha);
  const auto remarks = [&](std::uint32_t above, std::uint32_t below, std::uint32_t attributes) {
    std::string area = little(495, 2) + std::string(476, '\0') + little(above, 2) + little(below, 2);
    area += std::string(12, '\0') + little(attributes, 1);
    const std::string footer = little(18 + 8, 4) + little(0, 4) + std::string("TRUEVISION-XFILE.\0", 18);
    return tga(form, pixels, area + footer).remarks.size();
  };
  CHECK(remarks(0, 0, 3) == 0);
  CHECK(remarks(22, 10, 3) == 0);
  CHECK(remarks(1, 1, 3) == 1);
  CHECK(remarks(0, 0, 4) == 1);
}

}  // namespace tyndall::test::image_io_bmp_test

#include "tests/support/picture_bytes.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

namespace tyndall::test::image_io_hdr_test {
namespace fs = std::filesystem;

namespace {

constexpr const char* start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
/// Two pixels: (1, 2, 4) and (8, 0.5, 0.25).
const std::string two_pixels("\x20\x40\x80\x83\x80\x08\x04\x84", 8);
const std::vector<float> two_values{1, 2, 4, 8, 0.5f, 0.25f};

/// An HDR of 2 x 1 pixels with these lines.
std::string with_lines(const std::string& lines) { return start + lines + "\n-Y 1 +X 2\n" + two_pixels; }

}  // namespace

TEST_CASE("hdr: keeps 8 bits of the brightest channel, rounded to nearest") {
  const fs::path file = scratch_folder("hdr") / "a.hdr";
  LinearImage image{40, 25, {}};
  double sum = 0, read_sum = 0;
  for (int i = 0; i < 3000; ++i) {
    image.rgb.push_back(std::exp2(static_cast<float>(i / 3) / 50 - 10) * (i % 3 == 1 ? 0.7f : 1));
  }
  write_hdr(file, image);
  const LinearImage back = read_image(file);
  REQUIRE(back.rgb.size() == image.rgb.size());
  for (std::size_t i = 0; i < back.rgb.size(); ++i) {
    CHECK(std::abs(back.rgb[i] / image.rgb[i] - 1) <= 1.001f / 180);
    sum += static_cast<double>(image.rgb[i]);
    read_sum += static_cast<double>(back.rgb[i]);
  }
  CHECK(read_sum / sum == doctest::Approx(1).epsilon(5e-4).scale(0));
}

TEST_CASE("hdr: reads rows that are not compressed, and refuses headers that are something else") {
  const std::string head = "#?RADIANCE\n# a remark\nFORMAT=32-bit_rle_rgbe\n\n";
  // The first of 4 pixels looks like the start of a row in runs, but rows of fewer than 8 pixels are always plain.
  const std::string pixels(
      "\2\2\0\4"
      "\x80\0\0\x81"
      "\0\x40\0\x82"
      "\1\2\3\0",
      16);
  const std::vector<float> expected{0x1p-131f, 0x1p-131f, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  CHECK(light_of(head + "-Y 1 +X 4\n" + pixels) == expected);
  for (const char* size : {"-Y 4 +Y 1", "-Y 2 +X 4", "-Y 0 +X 4", "-Y -1 +X 4", "-Y 99999999 +X 99999999"})
    CHECK(message_for(head + size + "\n" + pixels) != "");
}

TEST_CASE("hdr: what the format cannot hold becomes the nearest that it can") {
  const fs::path file = scratch_folder("hdr_range") / "a.hdr";
  const float huge = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  write_hdr(file, {3, 1, {-1, 0.5f, nan, huge, 0, 0, 0, 0, -5}});
  const std::vector<float> rgb = read_image(file).rgb;
  CHECK(rgb[0] == 0);
  CHECK(rgb[1] == 0.5f);
  CHECK(rgb[2] == 0);
  CHECK(rgb[3] > 1.6e38f);
  CHECK(std::vector<float>(rgb.begin() + 4, rgb.end()) == std::vector<float>(5, 0.0f));
}

TEST_CASE("hdr: light is divided by the product of all EXPOSURE and COLORCORR lines") {
  CHECK(light_of(with_lines("")) == two_values);
  CHECK(light_of(with_lines("EXPOSURE=4\n")) == std::vector<float>{0.25f, 0.5f, 1, 2, 0.125f, 0.0625f});
  CHECK(light_of(with_lines("EXPOSURE= 8.000000e+00\nSOFTWARE=x\nEXPOSURE=0.5\n")) ==
        std::vector<float>{0.25f, 0.5f, 1, 2, 0.125f, 0.0625f});
  CHECK(light_of(with_lines("COLORCORR= 2 1 0.5\n")) == std::vector<float>{0.5f, 2, 8, 4, 0.5f, 0.5f});
  CHECK(light_of(with_lines("COLORCORR=2 1 1\nEXPOSURE=2\nCOLORCORR=1 1 4\n")) ==
        std::vector<float>{0.25f, 1, 0.5f, 2, 0.25f, 0.03125f});
  CHECK(light_of(with_lines("\tEXPOSURE=4\n")) == two_values);  // of a picture that this one was made of
  CHECK(message_for(with_lines("EXPOSURE=0\n")) == "found \"EXPOSURE=0\", expected numbers above 0");
  CHECK(message_for(with_lines("EXPOSURE=bright\n")) == "found \"EXPOSURE=bright\", expected 1 numbers");
  CHECK(message_for(with_lines("EXPOSURE=nan\n")) == "found \"EXPOSURE=nan\", expected numbers above 0");
  CHECK(message_for(with_lines("COLORCORR=1 2\n")) == "found \"COLORCORR=1 2\", expected 3 numbers");
}

TEST_CASE("hdr: a gamma, other primaries and other formats are refused by name") {
  CHECK(light_of(with_lines("GAMMA=1.0\n")) == two_values);
  CHECK(message_for(with_lines("GAMMA=2.2\n")) == "found \"GAMMA=2.2\", expected GAMMA=1, light itself");
  CHECK(light_of(with_lines("PRIMARIES=0.640 0.330 0.300 0.600 0.150 0.060 0.3127 0.3290\n")) == two_values);
  CHECK(light_of(with_lines("PRIMARIES= 0.6400 0.3300 0.2900 0.6000 0.1500 0.0600 0.3333 0.3333\n")) == two_values);
  CHECK(message_for(with_lines("PRIMARIES=0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.3290\n"))
            .ends_with(", expected the primaries of Rec.709"));
  CHECK(message_for("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n" + two_pixels) ==
        "found \"FORMAT=32-bit_rle_xyze\", expected FORMAT=32-bit_rle_rgbe");
  CHECK(message_for("#?RADIANCE\n\n-Y 1 +X 2\n" + two_pixels) ==
        "found no line FORMAT=32-bit_rle_rgbe in the header of the HDR");
  CHECK(light_of("#?RGBE\r\nFORMAT= 32-bit_rle_rgbe\r\nEXPOSURE=1\r\n\r\n-Y 1 +X 2\r\n" + two_pixels) == two_values);
  const std::string old("\x20\x40\x80\x83\1\1\1\1", 8);
  CHECK(message_for(start + std::string("\n-Y 1 +X 2\n") + old) ==
        "found an HDR with runs of the old kind, expected plain rows or the runs of today");
}

TEST_CASE("hdr: lines that mean nothing here change nothing") {
  CHECK(light_of(with_lines("VIEW= -vtv -vp 1 2 3\nPIXASPECT=1.5\nSOFTWARE=EXPOSURE=4\nrpict -x 2\n")) == two_values);
}

TEST_CASE("hdr: rows lie as the line of the size says") {
  // 3 x 2 pixels; the file's numbers 0 to 5 are the exponents of its pixels.
  std::string pixels;
  for (int i = 0; i < 6; ++i) pixels += std::string("\x80\0\0", 3) + static_cast<char>(129 + i);
  struct Case {
    const char* line;
    int width;
    std::vector<int> numbers;  ///< of the picture's pixels, from the top left
  };
  for (const Case& c : {Case{"-Y 2 +X 3", 3, {0, 1, 2, 3, 4, 5}}, Case{"+Y 2 +X 3", 3, {3, 4, 5, 0, 1, 2}},
                        Case{"-Y 2 -X 3", 3, {2, 1, 0, 5, 4, 3}}, Case{"+Y 2 -X 3", 3, {5, 4, 3, 2, 1, 0}},
                        Case{"+X 2 -Y 3", 2, {0, 3, 1, 4, 2, 5}}, Case{"-X 2 -Y 3", 2, {3, 0, 4, 1, 5, 2}},
                        Case{"+X 2 +Y 3", 2, {2, 5, 1, 4, 0, 3}}, Case{"-X 2 +Y 3", 2, {5, 2, 4, 1, 3, 0}}}) {
    const LinearImage image = picture_of(start + std::string("\n") + c.line + "\n" + pixels).image;
    CAPTURE(c.line);
    CHECK(image.width == c.width);
    CHECK(image.height == 6 / c.width);
    for (std::size_t i = 0; i < 6; ++i) CHECK(image.rgb[3 * i] == std::ldexp(1.0f, c.numbers[i]));
  }
  CHECK(message_for(start + std::string("\n+Z 2 +X 3\n") + pixels) ==
        "found \"+Z 2 +X 3\", expected the size of an HDR, such as -Y 480 +X 640");
}

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

}  // namespace tyndall::test::image_io_hdr_test

#include "tests/support/peak_memory.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/picture_files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::image_io_png_test {
namespace fs = std::filesystem;

namespace {

float decoded(double part) { return srgb_decode(static_cast<float>(part)); }

/// One pixel of RGB (51, 102, 255) with these chunks.
std::string pixel(const std::string& chunks = "") { return png_bytes({}, std::string("\0\x33\x66\xff", 4), chunks); }

std::string gama(std::uint32_t exponent) { return png_chunk_bytes("gAMA", big_endian(exponent)); }
std::string srgb() { return png_chunk_bytes("sRGB", std::string(1, '\0')); }
std::string cicp(const std::string& code) { return png_chunk_bytes("cICP", code); }

constexpr int p3_primaries[9] = {5151, 2412, -11, 2919, 6922, 419, 1572, 666, 7841};

bool is_srgb(const PictureFile& picture) {
  return picture.image.rgb == std::vector<float>{decoded(0.2), decoded(0.4), 1.0f};
}
bool is_linear(const PictureFile& picture) {
  return std::abs(picture.image.rgb[0] - 0.2f) < 1e-6f && std::abs(picture.image.rgb[1] - 0.4f) < 1e-6f;
}

}  // namespace

TEST_CASE("png: all 16 bits of a number count") {
  const auto grey = [](const std::string& number) { return png_bytes({1, 1, 16, 0}, std::string(1, '\0') + number); };
  const PictureFile low = picture_of(grey(std::string("\x80\0", 2)));
  CHECK(low.bits == 16);
  CHECK(low.image.rgb[0] == doctest::Approx(0.214048).epsilon(1e-5));
  CHECK(picture_of(grey("\x80\xff")).image.rgb[0] == doctest::Approx(0.217667).epsilon(1e-5));
  CHECK(picture_of(grey(std::string("\0\xff", 2))).image.rgb[0] == doctest::Approx(3.012e-4).epsilon(1e-3));
  const std::string colours = png_bytes({1, 1, 16, 2}, std::string("\0\x12\x34\x56\x78\xff\xff", 7));
  CHECK(picture_of(colours).image.rgb == std::vector<float>{decoded(0x1234 / 65535.0), decoded(0x5678 / 65535.0), 1});
}

TEST_CASE("png: greys, palettes and few bits") {
  CHECK(picture_of(png_bytes({4, 1, 2, 0}, std::string("\0\x1b", 2))).image.rgb ==
        std::vector<float>{0, 0, 0, decoded(85 / 255.0), decoded(85 / 255.0), decoded(85 / 255.0), decoded(170 / 255.0),
                           decoded(170 / 255.0), decoded(170 / 255.0), 1, 1, 1});
  const std::string palette = png_chunk_bytes("PLTE", std::string("\0\0\0\x33\x66\xff", 6));
  CHECK(picture_of(png_bytes({2, 1, 1, 3}, std::string("\0\x40", 2), palette)).image.rgb ==
        std::vector<float>{0, 0, 0, decoded(0.2), decoded(0.4), 1});
}

TEST_CASE("png: interlaced pictures have their pixels in place") {
  // 2 x 2 pixels: the first pass holds the first one, the sixth pass the second one, the last pass the second row.
  const std::string rows("\0\x01\0\x02\0\x03\x04", 7);
  const std::vector<float> rgb = picture_of(png_bytes({2, 2, 8, 0, true}, rows)).image.rgb;
  for (std::size_t i = 0; i < 4; ++i) CHECK(rgb[3 * i] == decoded(static_cast<double>(i + 1) / 255));
}

TEST_CASE("png: alpha is not looked at, but known to be there") {
  const PictureFile clear = picture_of(png_bytes({2, 1, 8, 6}, std::string("\0\x33\x66\xff\0\x33\x66\xff\xff", 9)));
  CHECK(clear.has_alpha);
  CHECK(clear.image.rgb[0] == decoded(0.2));
  CHECK_FALSE(picture_of(png_bytes({1, 1, 8, 6}, std::string("\0\x33\x66\xff\xff", 5))).has_alpha);
  CHECK(picture_of(png_bytes({1, 1, 8, 4}, std::string("\0\x33\x01", 3))).has_alpha);
  CHECK(picture_of(pixel(png_chunk_bytes("tRNS", std::string("\0\x33\0\x66\0\xff", 6)))).has_alpha);
  CHECK_FALSE(picture_of(pixel()).has_alpha);
}

TEST_CASE("png: gAMA makes the curve, unless it is near that of sRGB") {
  CHECK(is_srgb(picture_of(pixel())));
  CHECK(is_linear(picture_of(pixel(gama(100000)))));
  CHECK(picture_of(pixel(gama(50000))).image.rgb[1] == doctest::Approx(0.16));
  CHECK(picture_of(pixel(gama(55556))).image.rgb[1] == doctest::Approx(std::pow(0.4, 1.8)).epsilon(1e-4));
  for (const std::uint32_t near : {45455u, 43200u, 47700u}) CHECK(is_srgb(picture_of(pixel(gama(near)))));
  for (const std::uint32_t far : {43000u, 48000u}) CHECK_FALSE(is_srgb(picture_of(pixel(gama(far)))));
  CHECK(message_for(pixel(gama(0))) == "found the exponent (gAMA) 0, expected a number above 0");
  CHECK(message_for(pixel(png_chunk_bytes("gAMA", "12"))) == "damaged: found 2 bytes in the chunk gAMA, expected 4");
}

TEST_CASE("png: sRGB goes before iCCP, and iCCP before gAMA") {
  const std::string profile = iccp_chunk(icc_bytes(p3_primaries, srgb_icc_curve()));
  CHECK(is_srgb(picture_of(pixel(srgb() + gama(100000)))));
  CHECK(is_srgb(picture_of(pixel(gama(100000) + srgb()))));
  const PictureFile both = picture_of(pixel(srgb() + profile));
  CHECK(is_srgb(both));
  CHECK(both.remarks.empty());
  const PictureFile other = picture_of(pixel(gama(100000) + profile));
  CHECK(is_srgb(other));
  CHECK(other.remarks.size() == 1);
}

TEST_CASE("png: a colour profile is that of sRGB by its numbers, or told once") {
  const auto remarks = [](const std::string& profile) { return picture_of(pixel(iccp_chunk(profile))).remarks.size(); };
  const std::string curve_of_22 = std::string("curv\0\0\0\0\0\0\0\1\x02\x33", 14);
  const std::string curve_of_18 = std::string("curv\0\0\0\0\0\0\0\1\x01\xcd", 14);
  std::string table = "curv" + std::string(4, '\0') + big_endian(1024);
  for (int i = 0; i < 1024; ++i) {
    const int value = static_cast<int>(std::lround(65535 * static_cast<double>(decoded(i / 1023.0))));
    table += static_cast<char>(value >> 8), table += static_cast<char>(value & 255);
  }
  for (const std::string& curve : {srgb_icc_curve(), table, curve_of_22})
    CHECK(remarks(icc_bytes(srgb_primaries, curve)) == 0);
  CHECK(remarks(icc_bytes(srgb_primaries, curve_of_18)) == 1);
  CHECK(remarks(icc_bytes(srgb_primaries, std::string("curv\0\0\0\0\0\0\0\0", 12))) == 1);
  CHECK(remarks(icc_bytes(p3_primaries, srgb_icc_curve())) == 1);
  CHECK(remarks(icc_bytes(srgb_primaries, "none" + std::string(8, '\0'))) == 1);
  CHECK(remarks("no profile") == 1);
  const PictureFile picture = picture_of(pixel(iccp_chunk(icc_bytes(p3_primaries, srgb_icc_curve()))));
  CHECK(is_srgb(picture));
  CHECK(picture.remarks[0].ends_with(
      "a.picture: its colour profile (ICC) is not that of sRGB; its pixels are read as sRGB"));
  const auto grey = [](const std::string& curve) {
    return picture_of(
        png_bytes({1, 1, 8, 0}, std::string("\0\x33", 2), iccp_chunk(icc_bytes(srgb_primaries, curve, true))));
  };
  CHECK(grey(srgb_icc_curve()).remarks.empty());
  CHECK(grey(curve_of_18).remarks.size() == 1);
}

TEST_CASE("png: other primaries (cHRM) are told, unless sRGB or a profile goes before them") {
  std::string same, other;
  for (const std::uint32_t value : {31270u, 32900u, 64000u, 33000u, 30000u, 60000u, 15000u, 6000u})
    same += big_endian(value);
  for (const std::uint32_t value : {31270u, 32900u, 68000u, 32000u, 26500u, 69000u, 15000u, 6000u})
    other += big_endian(value);
  CHECK(picture_of(pixel(png_chunk_bytes("cHRM", same))).remarks.empty());
  const PictureFile told = picture_of(pixel(png_chunk_bytes("cHRM", other) + gama(100000)));
  CHECK(is_linear(told));
  REQUIRE(told.remarks.size() == 1);
  CHECK(told.remarks[0].ends_with("its primaries (cHRM) are not those of sRGB; its pixels are read as sRGB's"));
  CHECK(picture_of(pixel(png_chunk_bytes("cHRM", other) + srgb())).remarks.empty());
}

TEST_CASE("png: code points (cICP) go before all; curves that are not read are refused") {
  CHECK(is_srgb(picture_of(pixel(cicp(std::string("\1\x0d\0\1", 4)) + gama(100000)))));
  CHECK(is_linear(picture_of(pixel(cicp(std::string("\1\x08\0\1", 4)) + srgb()))));
  CHECK(picture_of(pixel(cicp(std::string("\x0c\x0d\0\1", 4)))).remarks.size() == 1);
  const PictureFile video = picture_of(pixel(cicp(std::string("\1\1\0\1", 4))));
  CHECK(is_srgb(video));
  REQUIRE(video.remarks.size() == 1);
  CHECK(video.remarks[0].ends_with("its curve (cICP) is that of videos; its pixels are read by that of sRGB"));
  CHECK(message_for(pixel(cicp(std::string("\x09\x10\0\1", 4)))) ==
        "found the colours (cICP) 9/16/0/1, expected 1/13/0/1, which is sRGB, 1/4/0/1 or 1/8/0/1");
  CHECK(message_for(pixel(cicp(std::string("\1\x0d\0\0", 4)))).starts_with("found the colours (cICP) 1/13/0/0"));
}

TEST_CASE("png: an orientation (eXIf) turns the picture; an animation's still picture is read and told") {
  std::string tiff = std::string("MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0", 26);
  const std::string rows("\0\x01\0\x02", 4);  // one column of two
  const PictureFile rotated = picture_of(png_bytes({1, 2, 8, 0}, rows, png_chunk_bytes("eXIf", tiff)));
  CHECK(rotated.image.width == 2);
  CHECK(rotated.image.rgb[0] == decoded(2 / 255.0));
  CHECK(rotated.image.rgb[3] == decoded(1 / 255.0));
  const PictureFile animated = picture_of(pixel(png_chunk_bytes("acTL", std::string("\0\0\0\2\0\0\0\0", 8))));
  REQUIRE(animated.remarks.size() == 1);
  CHECK(animated.remarks[0].ends_with("it is animated (acTL); its still picture is read"));
}

TEST_CASE("png: chunks that mean nothing here change nothing") {
  const std::string chunks = png_chunk_bytes("sBIT", "\5\6\5") +
                             png_chunk_bytes("pHYs", std::string("\0\0\0\1\0\0\0\2\0", 9)) +
                             png_chunk_bytes("bKGD", std::string("\0\1\0\2\0\3", 6)) +
                             png_chunk_bytes("tEXt", std::string("Gamma\0wrong", 11)) + png_chunk_bytes("prVt", "?");
  CHECK(is_srgb(picture_of(pixel(chunks))));
  CHECK(picture_of(pixel(chunks)).remarks.empty());
  CHECK(is_srgb(picture_of(pixel() + "what follows the last chunk")));
}

TEST_CASE("png: what a checksum calls damaged is refused") {
  const std::string whole = pixel(gama(45455));
  const auto damaged = [&](std::size_t at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    return message_for(bytes);
  };
  CHECK(damaged(whole.find("gAMA") + 7) == "damaged: gAMA: CRC error");
  CHECK(damaged(whole.find("IEND") - 5) == "damaged: IDAT: CRC error");
  CHECK(damaged(whole.find("IEND") + 5) == "damaged: IEND: CRC error");
  CHECK(damaged(29) == "damaged: IHDR: CRC error");
  // The compressed data's own checksum is wrong, and that of the chunk right.
  const std::size_t data = whole.find("IDAT") + 4, length = static_cast<unsigned char>(whole[data - 5]);
  std::string content = whole.substr(data, length);
  content.back() = static_cast<char>(content.back() ^ 1);
  const std::string bytes = whole.substr(0, data - 8) + png_chunk_bytes("IDAT", content) + png_chunk_bytes("IEND", "");
  CHECK(message_for(bytes) == "damaged: IDAT: incorrect data check");
  content.resize(length - 4);  // and here it is missing
  CHECK(message_for(whole.substr(0, data - 8) + png_chunk_bytes("IDAT", content) + png_chunk_bytes("IEND", ""))
            .starts_with("damaged: "));
}

TEST_CASE("png: a chunk that unpacks to much more than it is takes no memory") {
  std::string profile = icc_bytes(srgb_primaries, srgb_icc_curve());
  profile.resize(40'000'000);
  profile.replace(0, 4, big_endian(40'000'000));
  const std::string bytes = pixel(iccp_chunk(profile) + png_chunk_bytes("zTXt", std::string("a\0\0x", 4)));
  std::size_t remarks = 0;
  CHECK(peak_memory_of([&] { remarks = picture_of(bytes).remarks.size(); }) < 8 << 20);
  CHECK(remarks == 1);
}

TEST_CASE("png: a picture with a text of many megabytes is read") {
  const fs::path file = scratch_folder("png_long_text") / "a.png";
  write_png(file, {1, 1, {0, 0.5f, 1}}, 0, ToneMap::srgb, {std::string(20'000'000, 'x'), ""});
  CHECK(read_image(file).rgb[2] == 1);
}

}  // namespace tyndall::test::image_io_png_test

#include "core/image/pnm_reader.h"
#include "tests/support/peak_memory.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <vector>

/// A picture that comes in pieces is the one in the file, wherever the pieces are cut.

namespace tyndall::test::image_io_ppm_test {
namespace fs = std::filesystem;

namespace {

std::vector<float> light(const std::vector<int>& numbers, int largest) {
  std::vector<float> rgb;
  for (const int number : numbers) rgb.push_back(srgb_decode(static_cast<float>(number) / static_cast<float>(largest)));
  return rgb;
}

}  // namespace

TEST_CASE("ppm: P3 and P6, colours and greys, with remarks in the header, are read by sRGB's curve") {
  const std::vector<float> expected = light({0, 128, 255, 10, 20, 30}, 255);
  CHECK(light_of("P3\n2 1\n255\n0 128 255\n10 20 30\n") == expected);
  CHECK(light_of("P3 # made by hand\n#\n2#wide\r\n1 255 0 128 255 10 20# the last\n30") == expected);
  CHECK(light_of(std::string("P6\n2 1\n255\n\0\x80\xff\x0a\x14\x1e", 17)) == expected);
  CHECK(light_of(std::string("P6#x\n2 1 # y\n255#z\n\0\x80\xff\x0a\x14\x1e", 25)) == expected);
  CHECK(light_of("P2 2 1 255 7 9\n") == light({7, 7, 7, 9, 9, 9}, 255));
  CHECK(light_of("P5 2 1 255\n\x07\x09") == light({7, 7, 7, 9, 9, 9}, 255));
  const PictureFile picture = picture_of("P3 1 2 255 1 2 3 4 5 6");
  CHECK(picture.image.width == 1);
  CHECK(picture.image.height == 2);
  CHECK(picture.kind == ImageKind::ppm);
  CHECK(picture.bits == 8);
  CHECK(picture.remarks.empty());
  CHECK(read_texture(picture_file("P3 1 2 255 1 2 3 4 5 6")).image.rgb == picture.image.rgb);
}

TEST_CASE("ppm: any largest number, with two bytes above 255") {
  CHECK(light_of("P3 1 1 1000 0 500 1000") == light({0, 500, 1000}, 1000));
  CHECK(light_of("P3 1 1 1 0 1 0") == light({0, 1, 0}, 1));
  CHECK(light_of("P6 1 1 7\n\x01\x02\x07") == light({1, 2, 7}, 7));
  const PictureFile wide = picture_of(std::string("P6 1 1 65535\n\x80\0\x80\xff\0\xff", 19));
  CHECK(wide.image.rgb == light({0x8000, 0x80ff, 0x00ff}, 65535));
  CHECK(wide.bits == 16);
  CHECK(light_of(std::string("P6 1 1 256\n\x01\0\0\xff\0\0", 17)) == light({256, 255, 0}, 256));
}

TEST_CASE("ppm: --gamma2 reads the square of the numbers") {
  const std::vector<float> rgb = read_picture(picture_file("P3 1 1 255 0 51 255"), PpmCurve::gamma2).image.rgb;
  CHECK(rgb[0] == 0);
  CHECK(rgb[1] == doctest::Approx(0.04));
  CHECK(rgb[2] == 1);
}

TEST_CASE("ppm: numbers outside of the range are read as the nearest and counted in one line") {
  const fs::path file = picture_file("P3 2 1 255 256 -3 7 -2147483648 99999999999999999999 255");
  const PictureFile picture = read_picture(file);
  CHECK(picture.image.rgb == light({255, 0, 7, 0, 255, 255}, 255));
  REQUIRE(picture.remarks.size() == 1);
  CHECK(picture.remarks[0] == file.string() + ": 4 of 6 numbers are outside of 0 to 255 and are read as the nearest " +
                                  "that is within; the first one, 256, is at x 0, y 0");
  const PictureFile garbage = picture_of("P3 1 1 255 -2147483648 0 0");
  REQUIRE(garbage.remarks.size() == 1);
  CHECK(garbage.remarks[0].ends_with("the first one, -2147483648, is at x 0, y 0"));
  const PictureFile binary = picture_of("P6 1 2 100\n\x01\x02\x03\x04\xc8\x06");
  CHECK(binary.image.rgb == light({1, 2, 3, 4, 100, 6}, 100));
  REQUIRE(binary.remarks.size() == 1);
  CHECK(
      binary.remarks[0].ends_with(": 1 of 6 numbers are outside of 0 to 100 and are read as the nearest that is "
                                  "within; the first one, 200, is at x 0, y 1"));
}

TEST_CASE("ppm: a header with CR LF does not move the pixels by a byte") {
  const std::string pixels("\x0a\x02\x03", 3);
  CHECK(light_of("P6\r\n1 1\r\n255\r\n" + pixels) == light({10, 2, 3}, 255));
  CHECK(light_of("P6\r\n1 1\r\n255\n" + pixels) == light({10, 2, 3}, 255));
  // One character follows the header, and the first pixel begins with a line feed: nothing is left over.
  CHECK(light_of("P6 1 1 255\r" + pixels) == light({10, 2, 3}, 255));
}

TEST_CASE("ppm: what follows the picture is white space, or the file is refused") {
  CHECK(message_for("P6 1 1 255\n123\n\n") == "");
  CHECK(message_for("P6 1 1 255\n1234") == "found 1 bytes after the last pixel, expected none");
  CHECK(message_for("P6 1 1 255\n123P6 1 1 255\n123") == "found several pictures in one file, expected one");
  CHECK(message_for("P3 1 1 255 1 2 3 # end\n") == "");
  CHECK(message_for("P3 1 1 255 1 2 3 4") == "found 1 bytes after the last pixel, expected none");
  CHECK(message_for("P3 1 1 255 1 2 3\nP3 1 1 255 1 2 3\n") == "found several pictures in one file, expected one");
}

TEST_CASE("ppm: damaged and cut off ones are refused in one clear line") {
  CHECK(message_for("P6 1 x 255\n123") == "damaged: found \"x\", expected the height, a whole number");
  CHECK(message_for("P6 1.5 1 255\n123") == "damaged: found \"1.5\", expected the width, a whole number");
  CHECK(message_for("P6 1 1") == "damaged: the file ends where the largest number of a colour is expected");
  CHECK(message_for("P6 1 1 0\n123") == "found 0 as the largest number of a colour, expected 1 to 65535");
  CHECK(message_for("P6 1 1 65536\n123456") == "found 65536 as the largest number of a colour, expected 1 to 65535");
  CHECK(message_for("P6 99999999999999999999 2 255\n") ==
        "found a number beyond 2^28 as the width, expected a smaller one");
  CHECK(message_for("P6 0 1 255\n") == "found an image of 0 x 1 pixels, expected 1 to 2^28 in all");
  CHECK(message_for("P6 -1 -1 255\n123") == "found an image of -1 x -1 pixels, expected 1 to 2^28 in all");
  CHECK(message_for("P6 2 1 255\n12345") ==
        "damaged: found 6 bytes behind the header, expected at least 7 for 2 x 1 pixels");
  CHECK(message_for("P6 2 1 255#12345\n12345") == "damaged: the PPM ends in the middle");
  CHECK(message_for("P3 1 1 255 1 2 nan") == "damaged: found \"nan\", expected a colour, a whole number");
  CHECK(message_for("P3 1 1 255 1 2 0.5") == "damaged: found \"0.5\", expected a colour, a whole number");
  CHECK(message_for("P3 1 1 255 1 -") ==
        "damaged: found 4 bytes behind the header, expected at least 6 for 1 x 1 pixels");
  CHECK(message_for("P3 1 1 255 10 20") == "damaged: the file ends where a colour is expected");
  CHECK(message_for("P3 1 1 255 1 2 -\n") == "damaged: found \"-\", expected a colour, a whole number");
  CHECK(message_for("P4 1 1\n1") == "found a picture of the kind P4, expected P3 or P6 (colours), or P2 or P5 (greys)");
  CHECK(message_for("P7\nWIDTH 1\n").starts_with("found a picture of the kind P7, expected "));
}

TEST_CASE("ppm: a small one that says it is large takes no memory") {
  const auto refuses = [](const std::string& bytes) {
    std::string message;
    CHECK(peak_memory_of([&] { message = message_for(bytes); }) < 1 << 20);
    CHECK(message != "");
    CHECK(message.find('\n') == message.npos);
  };
  for (const std::string kind : {"P2", "P3", "P5", "P6"})
    for (const std::string size :
         {" 16384 16384 255\n1 2 3", " 99999999 99999999 255\n1 2 3", " 2147483648 1 255\n1 2 3",
          " 99999999999999999999999999 1 255\n1 2 3", " 4294967297 4294967297 255\n1 2 3"})
      refuses(kind + size);
  refuses("P6 " + std::string(100'000, '9') + " 1 255\n1 2 3");
}

TEST_CASE("ppm: is written as P6 with the bytes of the PNG, dithered or not") {
  const fs::path folder = scratch_folder("ppm_write");
  LinearImage image{24, 16, {}};
  for (int i = 0; i < 3 * 24 * 16; ++i) image.rgb.push_back(static_cast<float>(i) / 700);
  const std::string header = "P6\n24 16\n255\n";
  for (const ToneMap curve : {ToneMap::srgb, ToneMap::aces, ToneMap::agx})
    for (const bool dither : {false, true}) {
      const auto origin = dither ? std::optional(DitherOrigin{3, 5}) : std::nullopt;
      write_ppm(folder / "a.ppm", image, -0.5, curve, PpmCurve::srgb, origin);
      write_png(folder / "a.png", image, -0.5, curve, {}, origin);
      const std::string text = read_text(folder / "a.ppm");
      CHECK(text.starts_with(header));
      CHECK(text.size() == header.size() + 3 * 24 * 16);
      CHECK(read_image(folder / "a.ppm").rgb == read_image(folder / "a.png").rgb);
    }
}

// The books' write_color() in double, for each value.
TEST_CASE("ppm: --gamma2 writes the bytes of the books' programs") {
  const fs::path file = scratch_folder("ppm_gamma2") / "a.ppm";
  LinearImage image{100, 100, {}};
  for (int i = 0; i < 30000; ++i) image.rgb.push_back(static_cast<float>(i) / 25000 - 0.02f);
  for (int i = 0; i < 256; ++i) image.rgb[static_cast<std::size_t>(i)] = static_cast<float>(i * i) / 65536;  // exact
  image.rgb[300] = std::numeric_limits<float>::quiet_NaN();
  write_ppm(file, image, 0, ToneMap::srgb, PpmCurve::gamma2, DitherOrigin{});
  const std::string text = read_text(file);
  const std::size_t start = std::string("P6\n100 100\n255\n").size();
  REQUIRE(text.size() == start + 30000);
  int wrong = 0;
  for (std::size_t i = 0; i < 30000; ++i) {
    const double linear = static_cast<double>(image.rgb[i]), root = linear > 0 ? std::sqrt(linear) : 0;
    wrong += static_cast<unsigned char>(text[start + i]) != static_cast<int>(256 * std::min(root, 0.999));
  }
  CHECK(wrong == 0);
  const std::vector<float> back = read_picture(file, PpmCurve::gamma2).image.rgb;
  for (std::size_t i = 3000; i < 24000; ++i)
    wrong += std::abs(std::sqrt(back[i]) - std::sqrt(image.rgb[i])) > 1 / 255.0f;
  CHECK(wrong == 0);  // reading undoes writing
}

TEST_CASE("ppm: --gamma2 goes with exposure and tone maps") {
  CHECK(gamma2_bytes({0.25f, 1, 4}, -2, ToneMap::srgb) == std::vector<std::uint8_t>{64, 128, 255});
  const std::vector<std::uint8_t> aces = gamma2_bytes({0.18f, -1, 1e30f}, 0, ToneMap::aces);
  CHECK(aces == std::vector<std::uint8_t>{static_cast<std::uint8_t>(256 * std::sqrt(0.26688)), 0, 255});
  const std::vector<std::uint8_t> agx = gamma2_bytes({0.18f, 0.18f, 0.18f}, 0, ToneMap::agx);
  CHECK(agx[1] == static_cast<int>(256 * std::sqrt(std::pow(0.5, 2.2))));  // 0.18 is half of a screen of gamma 2.2
}

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

}  // namespace tyndall::test::image_io_ppm_test

#include "tests/support/peak_memory.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/picture_files.h"

#include <doctest/doctest.h>

#include <cstdlib>

namespace tyndall::test::image_io_jpeg_test {

namespace {

constexpr int width = 40, height = 24;

/// Colours that change slowly, so that JPEG keeps them nearly.
std::vector<std::uint8_t> slow_colours(int channels) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < channels; ++channel)
        pixels.push_back(static_cast<std::uint8_t>(channel == 0 ? 4 * x : channel == 1 ? 8 * y : 100));
  return pixels;
}

std::string good_jpeg(const JpegKind& kind = {}) {
  return jpeg_bytes(width, height, slow_colours(kind.channels), kind);
}

LinearImage image_with_exif(const std::string& exif) {
  JpegKind kind;
  kind.exif = exif;
  return picture_of(good_jpeg(kind)).image;
}

}  // namespace

TEST_CASE("jpeg: RGB and grey, sequential and progressive, and untransformed colours, as the marker of Adobe says") {
  const JpegKind kinds[] = {{3, false}, {3, true}, {1, false}, {1, true}, {3, false, false, true}};
  for (const JpegKind& kind : kinds) {
    const std::vector<std::uint8_t> pixels = slow_colours(kind.channels);
    const std::string bytes = good_jpeg(kind);
    if (kind.untransformed) REQUIRE(bytes.find("Adobe") != bytes.npos);
    const LinearImage image = picture_of(bytes).image;
    CHECK(image.width == width);
    CHECK(image.height == height);
    REQUIRE(image.rgb.size() == std::size_t{3} * width * height);
    const std::vector<std::uint8_t> read = tone_map(image.rgb, 0, ToneMap::srgb);
    int worst = 0;
    for (std::size_t i = 0; i < read.size(); ++i)
      worst = std::max(worst, std::abs(read[i] - pixels[kind.channels == 3 ? i : i / 3]));
    CHECK(worst <= 6);
  }
}

TEST_CASE("jpeg: kinds that are not read are refused by name; what follows the picture changes nothing") {
  CHECK(message_for(good_jpeg({4})) == "found a JPEG for printing (CMYK), expected RGB or grey");
  CHECK(message_for(good_jpeg({3, false, true})) == "found a JPEG with arithmetic coding, expected Huffman coding");
  std::string bytes = good_jpeg();
  CHECK(message_for(bytes + "more") == "");
  bytes[bytes.find("\xff\xc0") + 4] = 12;
  CHECK(message_for(bytes) == "damaged: Unsupported JPEG data precision 12");
}

TEST_CASE("jpeg: a Huffman table with more codes than fit is refused before anything is written past its end") {
  std::string bytes = good_jpeg();
  // The second table of codes: its 16 counts of codes of each length, which must not be above 256 in all.
  const std::size_t counts = bytes.find("\xff\xc4", bytes.find("\xff\xc4") + 2) + 5;
  bytes.replace(counts, 15, std::string(15, '\xaa'));
  CHECK(message_for(bytes) == "damaged: Bogus Huffman table definition");
}

TEST_CASE("jpeg: a file that is cut off is refused at any length") {
  for (const bool progressive : {false, true}) {
    const std::string whole = good_jpeg({3, progressive});
    for (std::size_t length = 3; length + 2 < whole.size(); length += 13)
      CHECK(message_for(whole.substr(0, length)).starts_with("damaged: "));
  }
}

TEST_CASE("jpeg: a small file cannot ask for much memory or time") {
  for (const bool progressive : {false, true}) {
    std::string bytes = good_jpeg({3, progressive});
    const std::size_t frame = bytes.find(progressive ? "\xff\xc2" : "\xff\xc0");
    bytes.replace(frame + 5, 4, "\x3f\xff\x3f\xff");  // 16383 x 16383 pixels
    std::string message;
    CHECK(peak_memory_of([&] { message = message_for(bytes); }) < 8 << 20);
    CHECK(message.find("expected at least 524224 for the size that it says") != message.npos);
  }
  std::string bytes = good_jpeg({1, true});
  const std::size_t scan = bytes.find("\xff\xda"), end = bytes.find('\xff', scan + 2);
  const std::string repeated = bytes.substr(scan, end - scan);
  for (int i = 0; i < 300; ++i) bytes.insert(scan, repeated);
  CHECK(message_for(bytes) == "damaged: more than 200 passes over the picture");
}

TEST_CASE("jpeg: the orientation in EXIF turns the picture") {
  // Where the file's first pixel lies, and the last one of its first row: 0: top left, 1: top right, 2: bottom left,
  // ...
  constexpr int first[8] = {0, 1, 3, 2, 0, 1, 3, 2}, end[8] = {1, 0, 2, 3, 2, 3, 1, 0};
  for (const bool little : {false, true})
    for (int orientation = 1; orientation <= 8; ++orientation) {
      const char value = static_cast<char>(orientation);
      const LinearImage image = image_with_exif(
          little ? std::string("II\x2a\0\x08\0\0\0\1\0\x12\x01\3\0\1\0\0\0", 18) + value + std::string(7, '\0')
                 : std::string("MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0", 19) + value + std::string(6, '\0'));
      CHECK(image.width == (orientation <= 4 ? width : height));
      CHECK(image.height == (orientation <= 4 ? height : width));
      const auto corner = [&](int which) {
        const int x = which % 2 == 0 ? 0 : image.width - 1, y = which / 2 == 0 ? 0 : image.height - 1;
        return &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
      };
      // Red grows along the file's rows, green from row to row: both are dark in the first pixel.
      CHECK(corner(first[orientation - 1])[0] < 0.01f);
      CHECK(corner(first[orientation - 1])[1] < 0.01f);
      CHECK(corner(end[orientation - 1])[0] > 0.3f);
      CHECK(corner(end[orientation - 1])[1] < 0.01f);
    }
}

TEST_CASE("jpeg: damaged EXIF says nothing") {
  const std::string good("MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0\6\0\0", 22);
  for (const std::string& exif : {good.substr(0, 12), std::string("MM\0\x2a\xff\xff\xff\xff", 8), std::string("MM"),
                                  std::string("XX\0\0\0\0\0\x08", 8), std::string("MM\0\x2a\0\0\0\x08\xff\xff", 10)})
    CHECK(image_with_exif(exif).width == width);
}

TEST_CASE("jpeg: a colour profile that is not sRGB's is told once") {
  const auto remarks = [](const std::string& profile) {
    JpegKind kind;
    kind.profile = profile;
    return picture_of(good_jpeg(kind)).remarks;
  };
  CHECK(remarks(icc_bytes(srgb_primaries, srgb_icc_curve())).empty());
  constexpr int adobe_primaries[9] = {6097, 3111, 195, 2053, 6257, 609, 1492, 632, 7446};
  const auto adobe = remarks(icc_bytes(adobe_primaries, srgb_icc_curve()));
  REQUIRE(adobe.size() == 1);
  CHECK(adobe[0].find("its colour profile (ICC) is not that of sRGB") != std::string::npos);
  CHECK(remarks("no profile").size() == 1);
}

}  // namespace tyndall::test::image_io_jpeg_test

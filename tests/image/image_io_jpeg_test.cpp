#include "core/image/image_io.h"
#include "tests/support/jpeg_files.h"
#include "tests/support/peak_memory.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace tyndall;
using namespace tyndall::test;
namespace fs = std::filesystem;

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

std::string good_jpeg(JpegKind kind = {}) { return jpeg_bytes(width, height, slow_colours(kind.channels), kind); }

/// What reading these bytes says, after the file's name; "" if they are read.
std::string message_for(const fs::path& file, const std::string& bytes) {
  write_text(file, bytes);
  try {
    read_rgb8(file);
  } catch (const ImageFileError& error) {
    return std::string(error.what()).substr(file.string().size());
  }
  return "";
}

}  // namespace

TEST_CASE("jpeg: RGB and grey, sequential and progressive, are read nearly as they were written") {
  const fs::path file = scratch_folder("jpeg") / "a.jpg";
  for (const JpegKind kind : {JpegKind{3, false}, JpegKind{3, true}, JpegKind{1, false}, JpegKind{1, true}}) {
    const std::vector<std::uint8_t> pixels = slow_colours(kind.channels);
    write_text(file, good_jpeg(kind));
    const Rgb8Image image = read_rgb8(file);
    CHECK(image.width == width);
    CHECK(image.height == height);
    REQUIRE(image.rgb.size() == std::size_t{3} * width * height);
    int worst = 0;
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      worst = std::max(worst, std::abs(image.rgb[i] - pixels[kind.channels == 3 ? i : i / 3]));
    CHECK(worst <= 6);
    CHECK(read_image(file).width == width);
  }
}

TEST_CASE("jpeg: kinds that are not read are refused by name") {
  const fs::path file = scratch_folder("jpeg_kinds") / "a.jpg";
  CHECK(message_for(file, good_jpeg({4})) == ": cannot read: found a JPEG for printing (CMYK), expected RGB or grey");
  CHECK(message_for(file, good_jpeg({3, false, true})) ==
        ": cannot read: found a JPEG with arithmetic coding, expected Huffman coding");
}

TEST_CASE("jpeg: a Huffman table with more codes than fit is refused before anything is written past its end") {
  const fs::path file = scratch_folder("jpeg_huffman") / "a.jpg";
  std::string bytes = good_jpeg();
  // The second table of codes: its 16 counts of codes of each length, which must not be above 256 in all.
  const std::size_t counts = bytes.find("\xff\xc4", bytes.find("\xff\xc4") + 2) + 5;
  bytes.replace(counts, 15, std::string(15, '\xaa'));
  CHECK(message_for(file, bytes) == ": cannot read: damaged: Bogus Huffman table definition");
}

TEST_CASE("jpeg: a file that is cut off is refused at any length") {
  const fs::path file = scratch_folder("jpeg_cut") / "a.jpg";
  for (const bool progressive : {false, true}) {
    const std::string whole = good_jpeg({3, progressive});
    for (std::size_t length = 3; length + 2 < whole.size(); length += 13)
      CHECK(message_for(file, whole.substr(0, length)).starts_with(": cannot read: damaged: "));
  }
}

TEST_CASE("jpeg: a small file cannot ask for much memory or time") {
  const fs::path file = scratch_folder("jpeg_memory") / "a.jpg";
  for (const bool progressive : {false, true}) {
    std::string bytes = good_jpeg({3, progressive});
    const std::size_t frame = bytes.find(progressive ? "\xff\xc2" : "\xff\xc0");
    bytes.replace(frame + 5, 4, "\x3f\xff\x3f\xff");  // 16383 x 16383 pixels
    std::string message;
    CHECK(peak_memory_of([&] { message = message_for(file, bytes); }) < 8 << 20);
    CHECK(message.find("expected at least 524224 for the size that it says") != message.npos);
  }
  std::string bytes = good_jpeg({1, true});
  const std::size_t scan = bytes.find("\xff\xda"), end = bytes.find('\xff', scan + 2);
  const std::string repeated = bytes.substr(scan, end - scan);
  for (int i = 0; i < 300; ++i) bytes.insert(scan, repeated);
  CHECK(message_for(file, bytes) == ": cannot read: damaged: more than 200 passes over the picture");
}

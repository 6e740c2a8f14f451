#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

namespace tyndall::test::image_io_test {
namespace fs = std::filesystem;

namespace {

LinearImage small_image() { return {2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0.25f, 0.125f, 2, 7.5f, 1e-4f, 0, 0, 0}}; }

/// The 8-bit numbers of a picture.
std::vector<std::uint8_t> bytes_in(const fs::path& file) { return tone_map(read_image(file).rgb, 0, ToneMap::srgb); }

const Embedded notes = {"{\"tyndall\": 1, \"name\": \"Nebel über Glas – 霧\"}", "{\"spp\": 16}"};

/// A chunk IHDR, IEND ... as it stands in a file: length, type, data, CRC.
std::string png_start(const std::string& after_header) {
  const fs::path file = scratch_folder("png_start") / "a.png";
  write_png(file, small_image(), 0, ToneMap::srgb, {});
  return read_text(file).substr(0, 33) + after_header;
}

}  // namespace

TEST_CASE("png: pixels, exposure and tone curve") {
  const fs::path file = scratch_folder("png") / "a.png";
  write_png(file, small_image(), 0, ToneMap::srgb, notes);
  CHECK(read_image(file).width == 2);
  CHECK(read_image(file).height == 3);
  CHECK(bytes_in(file) == tone_map(small_image().rgb, 0, ToneMap::srgb));
  write_png(file, small_image(), -2, ToneMap::aces, notes);
  CHECK(bytes_in(file) == tone_map(small_image().rgb, -2, ToneMap::aces));
}

TEST_CASE("png: carries the scene, byte for byte") {
  const fs::path folder = scratch_folder("png_scene");
  write_png(folder / "a.png", small_image(), 0, ToneMap::srgb, notes);
  CHECK(read_embedded_scene(folder / "a.png") == notes.scene);
  write_png(folder / "b.png", small_image(), 0, ToneMap::srgb, {});
  CHECK_FALSE(read_embedded_scene(folder / "b.png").has_value());
  const Embedded large = {std::string(3'000'000, 'x'), ""};
  write_png(folder / "c.png", small_image(), 0, ToneMap::srgb, large);
  CHECK(read_embedded_scene(folder / "c.png") == large.scene);
}

// The checksum AECE1CE9 of the chunk sRGB with intent 0 is known from the many PNG files that have this chunk.
TEST_CASE("png: chunks have length, type, data and checksum") {
  const fs::path file = scratch_folder("png_chunks") / "a.png";
  write_png(file, small_image(), 0, ToneMap::srgb, {"{}", ""});
  const std::string text = read_text(file);
  CHECK(text.substr(33, 13) == std::string("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13));
  CHECK(text.substr(46, 28) == std::string("\0\0\0\x14iTXttyndall:scene\0\0\0\0\0{}", 28));
  CHECK(text.substr(74, 4) == "\x5d\x75\xee\xb3");
  CHECK(text.substr(78 + 4, 4) == "IDAT");
}

TEST_CASE("png: broken chunks are one clear error") {
  const fs::path file = scratch_folder("png_broken") / "a.png";
  const auto message = [&](const std::string& bytes) -> std::string {
    write_text(file, bytes);
    try {
      return read_embedded_scene(file).value_or("none");
    } catch (const ImageFileError& error) {
      return std::string(error.what()).substr(file.string().size());
    }
  };
  CHECK(message(png_start("")) == ": cannot read: damaged: the PNG ends in the middle");
  CHECK(message(png_start("").substr(0, 20)) == ": cannot read: damaged: the PNG ends in the middle");
  CHECK(message(png_start("\xff\xff\xff\xffiTXt....")) == ": cannot read: damaged: the PNG ends in the middle");
  CHECK(message(png_start(std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12))) == "none");
  CHECK(message(png_start(std::string("\0\0\0\x10iTXttyndall:scene\0\0\0\0\0\0", 28))) ==
        ": cannot read: damaged: the checksum of the text tyndall:scene is wrong");
  write_png(file, small_image(), 0, ToneMap::srgb, notes);
  std::string damaged = read_text(file);
  damaged[damaged.find("Glas")] = 'g';
  CHECK(message(damaged) == ": cannot read: damaged: the checksum of the text tyndall:scene is wrong");
}

TEST_CASE("embedded scene: none in files that are no image or not there") {
  const fs::path folder = scratch_folder("no_image");
  write_text(folder / "scene.json", "{\"tyndall\": 1}");
  write_text(folder / "empty", "");
  CHECK_FALSE(read_embedded_scene(folder / "scene.json").has_value());
  CHECK_FALSE(read_embedded_scene(folder / "empty").has_value());
  CHECK_FALSE(read_embedded_scene(folder / "missing.png").has_value());
  CHECK_FALSE(read_embedded_scene(folder).has_value());
}

TEST_CASE("textures: what is no 8-bit image is refused in one line") {
  const fs::path folder = scratch_folder("rgb8_refused");
  write_hdr(folder / "a.hdr", small_image());
  CHECK_THROWS_WITH_AS(read_texture(folder / "a.hdr"),
                       ((folder / "a.hdr").string() +
                        ": cannot read: found floating-point pixels, expected 8 or 16 bits (PNG, PPM, JPEG, BMP, TGA)")
                           .c_str(),
                       ImageFileError);
  write_text(folder / "a.png", "hello");
  CHECK_THROWS_AS(read_texture(folder / "a.png"), ImageFileError);
  write_text(folder / "a.png", "");
  CHECK_THROWS_AS(read_texture(folder / "a.png"), ImageFileError);
  // A header that claims 20000 x 20000 pixels.
  std::string large = png_start("");
  large.replace(16, 8, std::string("\0\0\x4e\x20\0\0\x4e\x20", 8));
  write_text(folder / "a.png", large + std::string("\0\0\0\0IDAT\0\0\0\0\0\0\0\0IEND\xae\x42\x60\x82", 24));
  CHECK_THROWS_WITH_AS(
      read_texture(folder / "a.png"),
      ((folder / "a.png").string() + ": cannot read: found an image of 20000 x 20000 pixels, expected 1 to 2^28 in all")
          .c_str(),
      ImageFileError);
  CHECK_THROWS_WITH_AS(read_texture(folder / "none.png"),
                       ((folder / "none.png").string() + ": cannot read: No such file or directory").c_str(),
                       ImageFileError);
}

TEST_CASE("image output: by the ending of the name") {
  for (const char* name : {"a.png", "a.EXR", "b.c.Pfm", "dir/x.hdr", "y.PPM"}) CHECK(is_image_output(name));
  for (const char* name : {"a.jpg", "a", "png", ".png", "a.png.txt", "a.pngx", ""}) CHECK_FALSE(is_image_output(name));
}

TEST_CASE("read_image: refuses what is no image") {
  const fs::path file = scratch_folder("no_image") / "a.png";
  write_text(file, "{}");
  CHECK_THROWS_WITH_AS(
      read_image(file),
      (file.string() + ": cannot read: found no image, expected PNG, PPM, JPEG, BMP, TGA, PFM, HDR or EXR").c_str(),
      ImageFileError);
  CHECK_THROWS_AS(read_image(file.parent_path()), ImageFileError);
  CHECK_THROWS_AS(read_image("/dev/zero"), ImageFileError);
}

}  // namespace tyndall::test::image_io_test

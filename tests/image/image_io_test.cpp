#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

LinearImage small_image() { return {2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0.25f, 0.125f, 2, 7.5f, 1e-4f, 0, 0, 0}}; }

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
  Rgb8Image image = read_rgb8(file);
  CHECK(image.width == 2);
  CHECK(image.height == 3);
  CHECK(image.rgb == tone_map(small_image().rgb, 0, ToneMap::srgb));
  write_png(file, small_image(), -2, ToneMap::aces, notes);
  CHECK(read_rgb8(file).rgb == tone_map(small_image().rgb, -2, ToneMap::aces));
}

TEST_CASE("png: read as a linear image") {
  const fs::path file = scratch_folder("png_linear") / "a.png";
  write_png(file, small_image(), 0, ToneMap::srgb, {});
  const LinearImage image = read_image(file);
  CHECK(image.width == 2);
  CHECK(image.rgb[0] == 1.0f);
  CHECK(image.rgb[9] == doctest::Approx(srgb_decode(188.0f / 255)));
  CHECK(image.rgb[13] == 1.0f);  // clipped
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
  const fs::path file = scratch_folder("pfm_kinds") / "a.pfm";
  write_text(file, std::string("Pf 1 2 1\n\x3f\x80\0\0\xc0\0\0\0", 17));
  CHECK(read_image(file).rgb == std::vector<float>{-2, -2, -2, 1, 1, 1});
  write_text(file, std::string("Pf\n1 1\n-2.5\n\0\0\x80\x3f", 16));
  CHECK(read_image(file).rgb == std::vector<float>{2.5f, 2.5f, 2.5f});
}

TEST_CASE("pfm: damaged ones are refused") {
  const fs::path file = scratch_folder("pfm_damaged") / "a.pfm";
  for (const std::string text : {"PF\n", "PF\n2 2\n", "Pf\n1 1\n0\n1234", "Pf\n1 1\nnan\n1234", "Pf\n1 1\n-inf\n1234",
                                 "PF\n2 x\n-1\n", "PF\n2 2\n-1.0\n1234", "PF\n0 2\n-1.0\n", "PF\n-1 -1\n-1.0\n",
                                 "PF\n999999999 999999999\n-1.0\n", "PF\n2147483647 1\n-1.0\n"}) {
    CAPTURE(text);
    write_text(file, text);
    CHECK_THROWS_AS(read_image(file), ImageFileError);
  }
}

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
  const fs::path file = scratch_folder("hdr_kinds") / "a.hdr";
  const std::string start = "#?RADIANCE\n# a remark\nFORMAT=32-bit_rle_rgbe\n\n";
  // The first of 4 pixels looks like the start of a row in runs, but rows of fewer than 8 pixels are always plain.
  const std::string pixels(
      "\2\2\0\4"
      "\x80\0\0\x81"
      "\0\x40\0\x82"
      "\1\2\3\0",
      16);
  write_text(file, start + "-Y 1 +X 4\n" + pixels);
  CHECK(read_image(file).rgb == std::vector<float>{0x1p-131f, 0x1p-131f, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0});
  const auto refused = [&](const std::string& text) {
    write_text(file, text);
    CHECK_THROWS_AS(read_image(file), ImageFileError);
  };
  refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 4\n" + pixels);
  refused(start + "+X 4 -Y 1\n" + pixels);
  refused(start + "-Y 2 +X 4\n" + pixels);
  refused(start + "-Y 0 +X 4\n" + pixels);
  refused(start + "-Y -1 +X 4\n" + pixels);
  refused(start + "-Y 99999999 +X 99999999\n" + pixels);
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

// A 2 x 1 BMP and a 2 x 1 TGA of red and (64, 128, 192), and a grey PGM, byte by byte.
TEST_CASE("rgb8: reads other formats and numbers of channels") {
  const fs::path folder = scratch_folder("rgb8");
  const std::vector<std::uint8_t> expected = {255, 0, 0, 64, 128, 192};
  std::string bmp("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string("\0\0\xff\xc0\x80\x40\0\0", 8);
  write_text(folder / "a.bmp", bmp);
  CHECK(read_rgb8(folder / "a.bmp").rgb == expected);
  const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28\0\0\xff\xff\xc0\x80\x40\x10", 26);
  write_text(folder / "a.tga", tga);
  const Rgb8Image image = read_rgb8(folder / "a.tga");
  CHECK(image.rgb == expected);
  CHECK(image.width == 2);
  std::string grey("\0\0\3\0\0\0\0\0\0\0\0\0\1\0\1\0\x08\x20\x55", 19);
  write_text(folder / "grey.tga", grey);
  CHECK(read_rgb8(folder / "grey.tga").rgb == std::vector<std::uint8_t>{0x55, 0x55, 0x55});
}

TEST_CASE("rgb8: what is no 8-bit image is refused in one line") {
  const fs::path folder = scratch_folder("rgb8_refused");
  write_hdr(folder / "a.hdr", small_image());
  CHECK_THROWS_WITH_AS(read_rgb8(folder / "a.hdr"),
                       ((folder / "a.hdr").string() +
                        ": cannot read: found floating-point pixels, expected 8-bit ones (PNG, JPEG, BMP, TGA)")
                           .c_str(),
                       ImageFileError);
  write_text(folder / "a.png", "hello");
  CHECK_THROWS_AS(read_rgb8(folder / "a.png"), ImageFileError);
  write_text(folder / "a.png", "");
  CHECK_THROWS_AS(read_rgb8(folder / "a.png"), ImageFileError);
  // A header that claims 20000 x 20000 pixels.
  std::string large = png_start("");
  large.replace(16, 8, std::string("\0\0\x4e\x20\0\0\x4e\x20", 8));
  write_text(folder / "a.png", large + std::string("\0\0\0\0IDAT\0\0\0\0\0\0\0\0IEND\xae\x42\x60\x82", 24));
  CHECK_THROWS_WITH_AS(
      read_rgb8(folder / "a.png"),
      ((folder / "a.png").string() + ": cannot read: found an image of 20000 x 20000 pixels, expected 1 to 2^28 in all")
          .c_str(),
      ImageFileError);
  CHECK_THROWS_WITH_AS(read_rgb8(folder / "none.png"),
                       ((folder / "none.png").string() + ": cannot read: No such file or directory").c_str(),
                       ImageFileError);
}

TEST_CASE("image output: by the ending of the name") {
  for (const char* name : {"a.png", "a.EXR", "b.c.Pfm", "dir/x.hdr"}) CHECK(is_image_output(name));
  for (const char* name : {"a.jpg", "a", "png", ".png", "a.png.txt", "a.pngx", ""}) CHECK_FALSE(is_image_output(name));
}

TEST_CASE("read_image: refuses what is no image") {
  const fs::path file = scratch_folder("no_image") / "a.png";
  write_text(file, "{}");
  CHECK_THROWS_WITH_AS(read_image(file),
                       (file.string() + ": cannot read: found no image, expected PNG, JPEG, PFM, HDR or EXR").c_str(),
                       ImageFileError);
  CHECK_THROWS_AS(read_image(file.parent_path()), ImageFileError);
  CHECK_THROWS_AS(read_image("/dev/zero"), ImageFileError);
}

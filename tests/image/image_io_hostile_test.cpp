#include "core/image/image_io.h"
#include "tests/support/peak_memory.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::image_io_hostile_test {
namespace fs = std::filesystem;

namespace {

/// Reads a file in every way; only ImageFileError may come out. True if some way succeeded.
bool survives(const fs::path& file) {
  bool good = false;
  const auto attempt = [&](auto read) {
    try {
      read(file);
      good = true;
    } catch (const ImageFileError& error) {
      CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
  };
  attempt([](const fs::path& f) { read_image(f); });
  attempt([](const fs::path& f) { read_texture(f); });
  attempt([](const fs::path& f) { read_film(f); });
  attempt([](const fs::path& f) { read_embedded_scene(f); });
  return good;
}

LinearImage ramp() {
  LinearImage image{20, 12, {}};
  for (int i = 0; i < 720; ++i) image.rgb.push_back(static_cast<float>(i) / 400);
  return image;
}

std::vector<fs::path> good_files(const fs::path& folder) {
  const Embedded notes = {"{\"tyndall\": 1, \"objects\": []}", "{}"};
  write_png(folder / "a.png", ramp(), 0, ToneMap::srgb, notes);
  write_pfm(folder / "a.pfm", ramp());
  write_hdr(folder / "a.hdr", ramp());
  write_ppm(folder / "a.ppm", ramp(), 0, ToneMap::srgb);
  std::vector<fs::path> files = {folder / "a.png", folder / "a.pfm", folder / "a.hdr", folder / "a.ppm"};
  if (has_openexr()) {
    Film film = make_film(20, 12, {0, 0, 20, 12}, 0, 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = 4;
    write_exr(folder / "a.exr", film, {}, notes);
    files.push_back(folder / "a.exr");
  }
  return files;
}

}  // namespace

TEST_CASE("hostile files: cut off at any length") {
  const fs::path folder = scratch_folder("hostile_cut");
  for (const fs::path& file : good_files(folder)) {
    const std::string whole = read_text(file);
    const fs::path error = folder / "broken";
    for (std::size_t length = 0; length < whole.size(); length += length < 400 ? 7 : 97) {
      write_text(error, whole.substr(0, length));
      survives(error);
    }
    write_text(error, whole.substr(0, whole.size() / 2));
    CHECK_THROWS_AS(read_image(error), ImageFileError);
  }
}

TEST_CASE("hostile files: bytes changed anywhere") {
  const fs::path folder = scratch_folder("hostile_bytes");
  std::mt19937 engine(7);
  int good = 0;
  for (const fs::path& file : good_files(folder)) {
    CHECK(survives(file));
    const std::string whole = read_text(file);
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      const std::size_t reach = round % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 300);
      for (unsigned change = 0; change <= engine() % 4; ++change) {
        bytes[engine() % reach] = static_cast<char>(engine() % 3 == 0 ? 0xff : engine());
      }
      write_text(folder / "broken", bytes);
      good += survives(folder / "broken") ? 1 : 0;
    }
  }
  CHECK(good > 0);
}

TEST_CASE("hostile files: a small one that says it is large takes no memory") {
  const fs::path file = scratch_folder("hostile_large") / "a";
  const auto refuses = [&](const std::string& bytes) {
    write_text(file, bytes);
    CHECK(test::peak_memory_of([&] { survives(file); }) < 8 << 20);
    CHECK_THROWS_AS(read_texture(file), ImageFileError);
  };
  refuses("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 268435456\n");
  refuses("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n" + std::string(1000, 'x'));
  refuses("PF 16384 16384 -1\n" + std::string(1000, 'x'));
  // A BMP and a TGA of 16384 x 16384 pixels of 24 bits: what is missing is not taken for black.
  refuses(std::string("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\0\x40\0\0\0\x40\0\0\1\0\x18\0", 30) +
          std::string(1000, '\0'));
  refuses(std::string("\0\0\2\0\0\0\0\0\0\0\0\0\0\x40\0\x40\x18\0", 18) + std::string(1000, '\0'));
  refuses(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\2\0\0\0\0\0\0\0", 33) +
          std::string(1000, 'x'));
}

TEST_CASE("hostile files: a PNG with a chunk that says it is longer than the file is refused before it is decoded") {
  const fs::path file = scratch_folder("hostile_chunk") / "a.png";
  write_png(file, ramp(), 0, ToneMap::srgb, {});
  std::string bytes = read_text(file);
  bytes[bytes.find("IDAT") - 4] = 0x3f;  // the highest byte of its length: 1 GB
  write_text(file, bytes);
  CHECK_THROWS_WITH_AS(read_texture(file),
                       (file.string() + ": cannot read: damaged: the PNG ends in the middle").c_str(), ImageFileError);
}

TEST_CASE("hostile files: what a file says of itself comes out in one line") {
  const fs::path file = scratch_folder("hostile_lines") / "a.exr";
  write_text(file, std::string("\x76\x2f\x31\x01\2\0\0\0a\nb\0string\0\xff\xff\xff\x7fxx", 25));
  if (has_openexr()) CHECK_FALSE(survives(file));
}

}  // namespace tyndall::test::image_io_hostile_test

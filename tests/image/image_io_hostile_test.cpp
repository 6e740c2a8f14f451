#include "core/image/image_io.h"
#include "tests/support/peak_memory.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cstring>
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

namespace {

std::string number(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}
std::string attribute(const std::string& name, const std::string& type, std::uint32_t size, const std::string& value) {
  return name + '\0' + type + '\0' + number(size) + value;
}
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return attribute(name, type, static_cast<std::uint32_t>(value.size()), value);
}
std::string start(std::uint32_t flags = 0) { return "\x76\x2f\x31\x01" + number(2 | flags); }

/// A header as OpenEXR wants it, of a picture of that size with one channel R in float, and its end.
std::string header(std::uint32_t width, std::uint32_t height, char compression, const std::string& more = "") {
  const std::string window = number(0) + number(0) + number(width - 1) + number(height - 1);
  return attribute("channels", "chlist", std::string("R\0", 2) + number(2) + number(0) + number(1) + number(1) + '\0') +
         attribute("compression", "compression", std::string(1, compression)) +
         attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4)) + more + '\0';
}
std::string tiles(std::uint32_t width, std::uint32_t height) {
  return attribute("tiles", "tiledesc", number(width) + number(height) + '\0');
}

/// Expects every reader to refuse these bytes with this in the message, and to take little memory for it.
void check_refused(const std::string& bytes, const std::string& expected) {
  const fs::path file = scratch_folder("exr_hostile") / "a.exr";
  write_text(file, bytes);
  const auto check = [&](auto read) {
    std::string message = "read";
    const std::int64_t peak = peak_memory_of([&] {
      try {
        read(file);
      } catch (const ImageFileError& error) {
        message = error.what();
      }
    });
    CAPTURE(message);
    CHECK(message.find(expected) != message.npos);
    CHECK(message.find('\n') == message.npos);
    CHECK(peak < 8 << 20);
  };
  check([](const fs::path& f) { read_image(f); });
  check([](const fs::path& f) { read_film(f); });
  check([](const fs::path& f) { read_embedded_scene(f); });
}

}  // namespace

TEST_SUITE("exr hostile" * doctest::skip(!has_openexr())) {
  TEST_CASE("exr: lengths of attributes are believed only as far as the file goes") {
    check_refused(start() + attribute("a", "string", 0x7ffffff0, "xx"), "its attribute a says that it has 2147483632");
    check_refused(start() + attribute("a", "string", 0xffffffff, "xx"), "its attribute a says that it has 4294967295");
    check_refused(start() + attribute("a", "unknown", 0x7ffffff0, "xx"), "its attribute a says");
    check_refused(start() + attribute("a", "floatvector", 0x7ffffff0, "xx"), "its attribute a says");
    check_refused(start() + attribute("a", "int", 100, std::string(100, 'x')), "its attribute a says that it has 100");
    check_refused(start() + attribute("a", "floatvector", "12345"), "does not fill its 5 bytes");
    check_refused(start() + std::string(400, 'a'), "a name in the EXR's header is longer than 255 bytes");
    check_refused(start(), "the EXR's header ends early");
    check_refused(start() + attribute("a\nb", "string", 0x7fffffff, "xx"), "its attribute a");  // in one line
  }

  TEST_CASE("exr: lengths within attributes, too") {
    check_refused(start() + attribute("a", "stringvector", number(0x7ffffff0) + "abcdef"), "header ends early");
    check_refused(start() + attribute("a", "stringvector", number(3) + "abc" + number(9) + "a") + std::string(99, 'x'),
                  "does not fill");
    check_refused(start() + attribute("a", "preview", number(16384) + number(16384)), "its preview");
    check_refused(start() + attribute("a", "idmanifest", number(0x7ffffff0) + "abc"), "its list of names");
    check_refused(start() + attribute("channels", "chlist", "R"), "header ends early");
  }

  TEST_CASE("exr: windows, tiles and tables of chunks, too") {
    const std::string rest(64, '\0');
    check_refused(start() + header(1u << 30, 1u << 30, 0) + rest, "expected 1 to 2^28 in all");
    check_refused(start() + header(0, 5, 0) + rest, "expected 1 to 2^28 in all");
    check_refused(start() + header(1 << 14, 1 << 14, 3) + rest, "expected at least 766958 for the size");
    check_refused(start() + header(1, 1 << 28, 2) + rest, "expected at least 2147483648 for the size");
    check_refused(start() + header(1 << 28, 1, 0) + rest, "expected at least 1073741824 for the size");
    check_refused(start(0x200) + header(8, 8, 3, tiles(1u << 31, 1u << 31)) + rest, "its tiles have 2147483648 x");
    check_refused(start(0x200) + header(8, 8, 3, tiles(0, 8)) + rest, "its tiles have 0 x 8");
    check_refused(start(0x200) + header(8192, 8192, 3, tiles(1, 1)) + rest, "expected at least 536870912");
    check_refused(start(0x1000) + header(8, 8, 3, attribute("chunkCount", "int", number(1u << 30))) + '\0' + rest,
                  "expected at least 8589934592");
    check_refused(start(0x1000) + header(8, 8, 3) + header(1, 1 << 28, 2) + '\0' + rest, "expected at least 21474836");
    check_refused(start(0x800) + header(8, 8, 3) + rest, "found deep data (many depths a pixel)");
  }

  TEST_CASE("exr: films whose windows say more than the file holds take no memory") {
    const fs::path file = scratch_folder("exr_film_memory") / "a.exr";
    Film film = make_film(64, 64, {0, 0, 64, 64}, 0, 1);
    write_exr(file, film, {}, {});
    std::string bytes = read_text(file);
    const std::size_t window = bytes.find(std::string("dataWindow\0box2i\0\x10\0\0\0", 21)) + 21;
    bytes.replace(window + 8, 8, number(16383) + number(16383));
    check_refused(bytes, "expected at least 23775711 for the size that it says");
  }
}

}  // namespace tyndall::test::image_io_hostile_test

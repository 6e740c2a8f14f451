#include "core/image/image_io.h"
#include "tests/support/peak_memory.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cstring>

namespace tyndall::test::image_io_exr_hostile_test {
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t megabyte = 1 << 20;

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
    CHECK(peak < 8 * megabyte);
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

}  // namespace tyndall::test::image_io_exr_hostile_test

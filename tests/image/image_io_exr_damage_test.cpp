#ifdef TYNDALL_OPENEXR

#include "core/image/image_io.h"
#include "tests/support/exr_files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstring>
#include <random>

namespace tyndall::test::image_io_exr_damage_test {
namespace fs = std::filesystem;

namespace {

/// What OpenEXR itself reads of the channels R, G, B; nothing where it refuses.
std::optional<std::vector<float>> read_by_library(const fs::path& file) {
  try {
    Imf::InputFile exr(file.string().c_str());
    const Imath::Box2i window = exr.header().dataWindow();
    std::vector<float> rgb(
        static_cast<std::size_t>(3 * (window.max.x - window.min.x + 1) * (window.max.y - window.min.y + 1)));
    Imf::FrameBuffer frame;
    for (std::size_t k = 0; k < 3; ++k)
      frame.insert(std::string(1, "RGB"[k]), Imf::Slice::Make(Imf::FLOAT, rgb.data() + k, window, 12));
    exr.setFrameBuffer(frame);
    exr.readPixels(window.min.y, window.max.y);
    return rgb;
  } catch (const std::exception&) {
    return {};
  }
}

std::optional<std::vector<float>> read_here(const fs::path& file) {
  try {
    return read_image(file).rgb;
  } catch (const ImageFileError&) {
    return {};
  }
}

const std::vector<ExrSource> noise{{"R", [](int x, int y) { return static_cast<float>(x * 37 % 11 + y); }},
                                   {"G", [](int x, int y) { return static_cast<float>(y * 53 % 13 + x); }},
                                   {"B", [](int x, int y) { return static_cast<float>(x * y % 17); }}};

}  // namespace

TEST_CASE("EXR damage: pixels with a bit that has flipped are refused where OpenEXR does, and else the same") {
  const fs::path folder = scratch_folder("exr_flips");
  std::mt19937 engine(3);
  for (const Imf::Compression kind :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    CAPTURE(kind);
    Imf::Header header = exr_header(40, 40);
    header.compression() = kind;
    write_exr_file(folder / "a.exr", header, noise);
    const std::string good = read_text(folder / "a.exr");
    const std::size_t pixels = good.find("screenWindowWidth") + 60;
    int refused = 0;
    for (int round = 0; round < 60; ++round) {
      std::string bytes = good;
      char& byte = bytes[pixels + engine() % (bytes.size() - pixels)];
      byte = static_cast<char>(byte ^ (1 << engine() % 8));
      write_text(folder / "b.exr", bytes);
      const auto expected = read_by_library(folder / "b.exr"), found = read_here(folder / "b.exr");
      REQUIRE(found.has_value() == expected.has_value());
      if (found) REQUIRE(std::memcmp(found->data(), expected->data(), 4 * found->size()) == 0);
      refused += found ? 0 : 1;
    }
    if (kind == Imf::ZIP_COMPRESSION || kind == Imf::ZIPS_COMPRESSION) CHECK(refused > 50);
  }
}

namespace {

/// Where the table of the places of so many rows or tiles begins.
std::size_t table_in(const std::string& bytes, std::size_t count) {
  for (std::size_t at = 0; at + 8 < bytes.size(); ++at) {
    std::uint64_t first = 0;
    std::memcpy(&first, &bytes[at], 8);
    if (first == at + 8 * count) return at;
  }
  FAIL("no table");
  return 0;
}

}  // namespace

TEST_CASE("EXR damage: a file that was never finished is refused, unless all of its pixels are there") {
  const fs::path folder = scratch_folder("exr_rows");
  for (const bool tiled : {false, true}) {
    CAPTURE(tiled);
    Imf::Header header = exr_header(40, 40);
    if (tiled) header.setTileDescription({16, 16, Imf::ONE_LEVEL});
    write_exr_file(folder / "a.exr", header, noise);
    std::string bytes = read_text(folder / "a.exr");
    const std::size_t count = tiled ? 9 : 40;
    bytes.replace(table_in(bytes, count), 8 * count, 8 * count, '\0');
    write_text(folder / "b.exr", bytes);
    CHECK(read_here(folder / "b.exr") == read_here(folder / "a.exr"));
    for (const std::size_t missing : {1u, 3000u, 12000u}) {
      write_text(folder / "b.exr", bytes.substr(0, bytes.size() - missing));
      CHECK_FALSE(read_here(folder / "b.exr").has_value());
    }
  }
}

#endif

}  // namespace tyndall::test::image_io_exr_damage_test

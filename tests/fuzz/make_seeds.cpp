// Writes what fuzzing starts from: make_seeds FOLDER, which gets a folder for each format.
#include "core/image/image_io.h"
#include "tests/support/exr_files.h"
#include "tests/support/picture_files.h"

#include <OpenEXR/ImfStandardAttributes.h>

#include <fstream>
#include <iostream>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

constexpr int width = 12, height = 9;

LinearImage ramp() {
  LinearImage image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(static_cast<float>(i) / 200);
  return image;
}

/// Creates the folder of a format.
fs::path of(const fs::path& folder, const char* format) {
  fs::create_directories(folder / format);
  return folder / format;
}

/// One channel, tiled or in rows.
void write_plain_exr(const fs::path& file, Imf::Compression compression, bool tiled) {
  const LinearImage image = ramp();
  Imf::Header header = test::exr_header(width, height);
  header.compression() = compression;
  if (tiled) header.setTileDescription(Imf::TileDescription(8, 8));
  std::vector<test::ExrSource> channels;
  for (int c = 0; c < 3; ++c)
    channels.push_back(
        {std::string(1, "RGB"[c]),
         [&image, c](int x, int y) { return image.rgb[static_cast<std::size_t>(3 * (y * width + x) + c)]; },
         Imf::HALF});
  test::write_exr_file(file, header, channels);
}

/// What other programs write: layers, several parts, views, luminance and chroma, pixels with many depths.
void write_foreign_exr(const fs::path& folder) {
  using test::constant_channels, test::exr_header;
  const auto part = [](const char* name, const std::vector<std::pair<std::string, float>>& channels) {
    test::ExrPartSource made{exr_header(4, 3), constant_channels(channels)};
    made.header.setName(name);
    return made;
  };
  const auto colour = part("a", {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}}), depth = part("depth", {{"Z", 1.0f}});
  test::write_exr_file(folder / "parts", {depth, colour});
  test::write_exr_file(folder / "layers", exr_header({0, 0, 4, 4}, {-1, -1, 5, 5}),
                       constant_channels({{"a.R", 1.0f}, {"a.G", 2.0f}, {"a.B", 3.0f}, {"Z", 1.0f}}));
  Imf::Header wide = exr_header(4, 4);
  Imf::addChromaticities(wide, Imf::Chromaticities({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32f, 0.34f}));
  test::write_exr_file(folder / "chroma", wide, constant_channels({{"Y", 1.0f}, {"RY", 0.5f}, {"BY", 0.0f}}));
  test::write_luminance_chroma(folder / "sampled", wide, [](int, int) { return std::vector{0.8f, 0.2f, 0.1f}; });
  test::write_deep_exr(folder / "deep", {colour});
}

Film small_film(bool emission, bool planned) {
  Film film = make_film(6, 4, {1, 0, 5, 4}, 0, 2, emission);
  for (FilmPixel& pixel : film.pixels) {
    for (std::uint32_t i = 0; i < 4; ++i) add_sample(pixel, i & 1u, {0.5f, 0.25f, 1}, 1 / film.quantum);
    pixel.taken = 4;
  }
  if (planned) film.planned.assign(1, {2, 8});
  return film;
}

void write_films(const fs::path& folder) {
  const Embedded notes{"{\"tyndall\": 1}", "{}", {"0.1.0", "scalar", true}};
  write_checkpoint(folder / "plain.exr", small_film(false, false), notes);
  write_checkpoint(folder / "emission.exr", small_film(true, false), notes);
  write_checkpoint(folder / "planned.exr", small_film(true, true), notes);
  write_exr(folder / "whole.exr", small_film(true, false), {}, notes);
}

/// A BMP and a TGA of 2 x 1 pixels.
void write_stb_kinds(const fs::path& folder) {
  std::string bmp("BM\x3e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string("\0\0\xff\xc0\x80\x40\0\0", 8);
  std::ofstream(of(folder, "bmp") / "a.bmp", std::ios::binary) << bmp;
  const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28\0\0\xff\xff\xc0\x80\x40\x10", 26);
  std::ofstream(of(folder, "tga") / "a.tga", std::ios::binary) << tga;
}

void write_seeds(const fs::path& folder) {
  const Embedded notes = {"{\"tyndall\": 1, \"objects\": []}", "{}", {}};
  write_png(of(folder, "png") / "a.png", ramp(), 0, ToneMap::srgb, notes);
  write_pfm(of(folder, "pfm") / "a.pfm", ramp());
  write_hdr(of(folder, "hdr") / "a.hdr", ramp());
  write_ppm(of(folder, "ppm") / "a.ppm", ramp(), 0, ToneMap::srgb);
  std::ofstream(folder / "ppm" / "text") << "P3 # by hand\n2 1\n255\n1 2 3\n4 5 -6\n";
  write_stb_kinds(folder);
  for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i)
    for (const bool tiled : {false, true})
      write_plain_exr(of(folder, "exr") / (std::to_string(i) + (tiled ? "tiled" : "rows")),
                      static_cast<Imf::Compression>(i), tiled);
  write_foreign_exr(of(folder, "exr"));
  write_films(of(folder, "film"));
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 3 * width * height; ++i) pixels.push_back(static_cast<std::uint8_t>(i));
  for (const int channels : {1, 3})
    for (const bool progressive : {false, true}) {
      const fs::path file =
          of(folder, "jpeg") / (std::to_string(channels) + (progressive ? "progressive" : "sequential"));
      std::ofstream(file, std::ios::binary) << test::jpeg_bytes(width, height, pixels, {channels, progressive});
    }
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  try {
    write_seeds(words[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

#pragma once
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// EXR files as other programs write them, made by OpenEXR itself.
namespace tyndall::test {

/// A channel and its value at each pixel, in the coordinates of the data window.
struct ExrSource {
  std::string name;
  std::function<float(int x, int y)> value;
  Imf::PixelType type = Imf::FLOAT;
  int every_x = 1, every_y = 1;  ///< pixels that share a value
};

struct ExrPartSource {
  Imf::Header header;
  std::vector<ExrSource> channels;
};

/// A header of that size, uncompressed, with its data window in the middle of nothing else.
Imf::Header exr_header(int width, int height);
/// The same with windows: x0, y0, x1, y1, the last ones beyond the last pixel.
Imf::Header exr_header(const std::vector<int>& display, const std::vector<int>& data);

/// Channels of one value each everywhere.
std::vector<ExrSource> constant_channels(const std::vector<std::pair<std::string, float>>& values);

/// One part by scan lines, or, where the header has tiles, by tiles; lower levels are 0.
void write_exr_file(const std::filesystem::path& file, Imf::Header header, const std::vector<ExrSource>& channels);
/// Several parts by scan lines; each header needs a name of its own.
void write_exr_file(const std::filesystem::path& file, std::vector<ExrPartSource> parts);
/// A part of pixels with many depths and the channels R, G, B, and, if there are some, further parts.
void write_deep_exr(const std::filesystem::path& file, std::vector<ExrPartSource> further = {});
/// Luminance and chroma by OpenEXR's RgbaOutputFile; colour(x, y)[0 ... 2].
void write_luminance_chroma(const std::filesystem::path& file, const Imf::Header& header,
                            const std::function<std::vector<float>(int x, int y)>& colour);

}  // namespace tyndall::test

#include "tests/support/exr_files.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <cstdint>
#include <cstring>
#include <deque>

namespace tyndall::test {

namespace {

/// The values of channels as they lie in memory while they are written.
struct Buffers {
  Imf::FrameBuffer frame{};
  std::deque<std::vector<char>> values{};

  void add(const ExrSource& source, const Imath::Box2i& window) {
    const std::size_t size = source.type == Imf::HALF ? 2 : 4;
    std::vector<char>& bytes = values.emplace_back();
    for (int y = window.min.y; y <= window.max.y; y += source.every_y)
      for (int x = window.min.x; x <= window.max.x; x += source.every_x) {
        const float value = source.value(x, y);
        char raw[4];
        const half small(value);
        const auto whole = source.type == Imf::UINT ? static_cast<std::uint32_t>(value) : 0u;
        if (source.type == Imf::HALF) std::memcpy(raw, &small, 2);
        if (source.type == Imf::FLOAT) std::memcpy(raw, &value, 4);
        if (source.type == Imf::UINT) std::memcpy(raw, &whole, 4);
        bytes.insert(bytes.end(), raw, raw + size);
      }
    const auto columns = static_cast<std::size_t>((window.max.x - window.min.x) / source.every_x + 1);
    frame.insert(source.name, Imf::Slice::Make(source.type, bytes.data(), window, size, size * columns, source.every_x,
                                               source.every_y));
  }
};

Buffers prepare(Imf::Header& header, const std::vector<ExrSource>& channels) {
  Buffers buffers;
  for (const ExrSource& source : channels) {
    header.channels().insert(source.name, Imf::Channel(source.type, source.every_x, source.every_y));
    buffers.add(source, header.dataWindow());
  }
  return buffers;
}

/// The name of a new file. OpenEXR 3.1 does not cut off the rest of an old one under Windows.
std::string fresh(const std::filesystem::path& file) {
  std::filesystem::remove(file);
  return file.string();
}

void write_tiles(const std::filesystem::path& file, const Imf::Header& header, const Imf::FrameBuffer& frame) {
  Imf::TiledOutputFile exr(fresh(file).c_str(), header);
  exr.setFrameBuffer(frame);
  exr.writeTiles(0, exr.numXTiles(0) - 1, 0, exr.numYTiles(0) - 1, 0, 0);
  std::vector<float> nothing(1 << 16);  // rows overlap, and small coordinates may be negative
  Imf::FrameBuffer black;
  for (auto slice = frame.begin(); slice != frame.end(); ++slice)
    black.insert(slice.name(), Imf::Slice(slice.slice().type, reinterpret_cast<char*>(&nothing[1 << 15]), 4, 4));
  exr.setFrameBuffer(black);
  for (int ly = 0; ly < exr.numYLevels(); ++ly)
    for (int lx = 0; lx < exr.numXLevels(); ++lx)
      if (exr.isValidLevel(lx, ly) && lx + ly > 0)
        exr.writeTiles(0, exr.numXTiles(lx) - 1, 0, exr.numYTiles(ly) - 1, lx, ly);
}

}  // namespace

Imf::Header exr_header(int width, int height) { return exr_header({0, 0, width, height}, {0, 0, width, height}); }

Imf::Header exr_header(const std::vector<int>& display, const std::vector<int>& data) {
  const auto box = [](const std::vector<int>& r) { return Imath::Box2i({r[0], r[1]}, {r[2] - 1, r[3] - 1}); };
  Imf::Header header(box(display), box(data));
  header.compression() = Imf::NO_COMPRESSION;
  return header;
}

std::vector<ExrSource> constant_channels(const std::vector<std::pair<std::string, float>>& values) {
  std::vector<ExrSource> channels;
  for (const auto& [name, value] : values) channels.push_back({name, [v = value](int, int) { return v; }});
  return channels;
}

void write_exr_file(const std::filesystem::path& file, Imf::Header header, const std::vector<ExrSource>& channels) {
  const Buffers buffers = prepare(header, channels);
  if (header.hasTileDescription()) return write_tiles(file, header, buffers.frame);
  Imf::OutputFile exr(fresh(file).c_str(), header);
  exr.setFrameBuffer(buffers.frame);
  exr.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

void write_exr_file(const std::filesystem::path& file, std::vector<ExrPartSource> parts) {
  std::vector<Imf::Header> headers;
  std::deque<Buffers> buffers;  // which stay where they are
  for (ExrPartSource& part : parts) {
    buffers.push_back(prepare(part.header, part.channels));
    part.header.setType(Imf::SCANLINEIMAGE);
    headers.push_back(part.header);
  }
  Imf::MultiPartOutputFile exr(fresh(file).c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t i = 0; i < headers.size(); ++i) {
    Imf::OutputPart part(exr, static_cast<int>(i));
    part.setFrameBuffer(buffers[i].frame);
    part.writePixels(headers[i].dataWindow().max.y - headers[i].dataWindow().min.y + 1);
  }
}

void write_deep_exr(const std::filesystem::path& file, std::vector<ExrPartSource> further) {
  constexpr int width = 4, height = 3;
  Imf::Header header(width, height);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.setName("deep"), header.setType(Imf::DEEPSCANLINE);
  std::vector<unsigned> counts(width * height, 1);
  std::vector<float> values(width * height, 0.5f);
  std::vector<float*> pointers;
  for (float& value : values) pointers.push_back(&value);
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * width));
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), sizeof(float*),
                                      sizeof(float*) * width, sizeof(float)));
  }
  std::vector<Imf::Header> headers{header};
  std::deque<Buffers> buffers;
  for (ExrPartSource& part : further) {
    buffers.push_back(prepare(part.header, part.channels));
    part.header.setType(Imf::SCANLINEIMAGE);
    headers.push_back(part.header);
  }
  Imf::MultiPartOutputFile exr(fresh(file).c_str(), headers.data(), static_cast<int>(headers.size()));
  Imf::DeepScanLineOutputPart deep(exr, 0);
  deep.setFrameBuffer(frame);
  deep.writePixels(height);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    Imf::OutputPart part(exr, static_cast<int>(i + 1));
    part.setFrameBuffer(buffers[i].frame);
    part.writePixels(further[i].header.dataWindow().max.y - further[i].header.dataWindow().min.y + 1);
  }
}

void write_luminance_chroma(const std::filesystem::path& file, const Imf::Header& header,
                            const std::function<std::vector<float>(int x, int y)>& colour) {
  const Imath::Box2i& window = header.dataWindow();
  std::vector<Imf::Rgba> pixels;
  for (int y = window.min.y; y <= window.max.y; ++y)
    for (int x = window.min.x; x <= window.max.x; ++x) {
      const std::vector<float> rgb = colour(x, y);
      pixels.emplace_back(rgb[0], rgb[1], rgb[2], 1.0f);
    }
  Imf::RgbaOutputFile exr(fresh(file).c_str(), header, Imf::WRITE_YC);
  exr.setFrameBuffer(Imf::ComputeBasePointer(pixels.data(), window), 1,
                     static_cast<std::size_t>(window.max.x - window.min.x + 1));
  exr.writePixels(window.max.y - window.min.y + 1);
}

}  // namespace tyndall::test

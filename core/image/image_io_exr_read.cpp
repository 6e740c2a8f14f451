#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr_open.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace tyndall {
namespace {

Region region_of(const Imath::Box2i& window) {
  return {window.min.x, window.min.y, window.max.x + 1, window.max.y + 1};
}

/// The picture without its pixels, which are black.
LinearImage empty_picture(const std::filesystem::path& file, const Imf::Header& header) {
  const auto [width, height] = size_of(file, header.dataWindow());
  LinearImage image{width, height, {}, ImageFrame{region_of(header.displayWindow()), region_of(header.dataWindow())}};
  image.frame->pixel_aspect = header.pixelAspectRatio();
  if (Imf::hasWhiteLuminance(header)) image.frame->white_luminance = Imf::whiteLuminance(header);
  image.rgb.resize(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return image;
}

/// How many columns and rows of pixels share a value of a channel.
std::pair<int, int> sampling_of(const Imf::Header& header, const std::string& name) {
  const Imf::Channel& channel = header.channels()[name];
  return {channel.xSampling, channel.ySampling};
}

void check_sampling(const std::filesystem::path& file, const Imf::Header& header, const std::string& name) {
  const auto [x, y] = sampling_of(header, name);
  if (x == 1 && y == 1) return;
  cannot_read(file, "found one value for every " + std::to_string(x) + " x " + std::to_string(y) +
                        " pixels in channel " + name + ", expected one for each pixel");
}

/// Reads channels that have a value for each pixel into red, green and blue, or one into all three.
void read_channels(const std::filesystem::path& file, Imf::MultiPartInputFile& exr, const ExrLayer& layer,
                   LinearImage& image) {
  const Imf::Header& header = exr.header(layer.part);
  ExrTarget target{{}, header.dataWindow()};
  float* rgb = image.rgb.data();
  for (std::size_t i = 0; i < layer.channels.size(); ++i) {
    check_sampling(file, header, layer.channels[i]);
    target.add(layer.channels[i], Imf::FLOAT, rgb + i, 3 * sizeof(float));
  }
  target.read(exr, layer.part);
  for (std::size_t i = 0; layer.channels.size() == 1 && i < image.rgb.size(); i += 3) rgb[i + 1] = rgb[i + 2] = rgb[i];
}

/// Luminance and chroma with a value for each pixel, by the definitions in OpenEXR's ImfRgbaYca.h.
void read_whole_chroma(const std::filesystem::path& file, Imf::MultiPartInputFile& exr, const ExrLayer& layer,
                       LinearImage& image) {
  read_channels(file, exr, layer, image);
  const Imath::V3f weights = luminance_weights(file, exr.header(layer.part));
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const float y = image.rgb[i], red = (image.rgb[i + 1] + 1) * y, blue = (image.rgb[i + 2] + 1) * y;
    image.rgb[i] = red, image.rgb[i + 1] = (y - red * weights.x - blue * weights.z) / weights.y,
    image.rgb[i + 2] = blue;
  }
}

/// Luminance for each pixel and chroma for every 2 x 2, by OpenEXR's own filter, in its 16 bits a value.
void read_half_chroma(const std::filesystem::path& file, const ExrLayer& layer, LinearImage& image) {
  Imf::RgbaInputFile exr(file.c_str(), layer.prefix);
  const Region& data = image.frame->data;
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(image.width));
  exr.setFrameBuffer(Imf::ComputeBasePointer(row.data(), {data.x0, 0}, image.width), 1, 0);
  auto* to = image.rgb.data();
  for (int y = data.y0; y < data.y1; ++y) {
    exr.readPixels(y);
    for (const Imf::Rgba& pixel : row)
      for (const float value : {pixel.r, pixel.g, pixel.b}) *to++ = value;
  }
}

void read_luminance_chroma(const std::filesystem::path& file, Imf::MultiPartInputFile& exr, const ExrLayer& layer,
                           LinearImage& image) {
  const Imf::Header& header = exr.header(layer.part);
  const bool half = sampling_of(header, layer.channels[1]) == std::pair{2, 2} &&
                    sampling_of(header, layer.channels[2]) == std::pair{2, 2};
  if (!half) return read_whole_chroma(file, exr, layer, image);
  check_sampling(file, header, layer.channels[0]);
  luminance_weights(file, header);  // refuses chromaticities that cannot be
  if (exr.parts() > 1)
    cannot_read(file, "found luminance and chroma of 2 x 2 pixels in a file of several parts, expected one part");
  read_half_chroma(file, layer, image);
}

}  // namespace

LinearImage read_exr(const std::filesystem::path& file, const std::optional<std::string>& name) {
  return with_exr(file, [&](Imf::MultiPartInputFile& exr) {
    const ExrLayer layer = find_exr_layer(file, exr, name);
    const Imf::Header& header = exr.header(layer.part);
    LinearImage image = empty_picture(file, header);
    if (layer.colour == ExrColour::luminance_chroma)
      read_luminance_chroma(file, exr, layer, image);
    else
      read_channels(file, exr, layer, image);
    if (layer.colour == ExrColour::luminance_chroma || layer.colour == ExrColour::rgb)
      convert_to_rec709(file, header, image.rgb);
    return image;
  });
}

}  // namespace tyndall

#endif

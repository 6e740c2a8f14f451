#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr.h"

#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfRgbaYca.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cmath>
#include <exception>

namespace tyndall {
namespace {

/// Chromaticities are written with four decimals.
bool near(const Imath::V2f& a, const Imath::V2f& b) {
  return std::abs(a.x - b.x) < 1e-4f && std::abs(a.y - b.y) < 1e-4f;
}

bool near(const Imf::Chromaticities& a, const Imf::Chromaticities& b) {
  return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) && near(a.white, b.white);
}

/// Twice the area of the triangle of the primaries on the chromaticity diagram; Rec.709: 0.22.
float area_of(const Imf::Chromaticities& c) {
  const Imath::V2f a = c.green - c.red, b = c.blue - c.red;
  return std::abs(a.x * b.y - a.y * b.x);
}

/// Whether a matrix leads from the primaries to XYZ and back.
bool span_colours(const Imf::Chromaticities& c) {
  try {
    const Imath::V3f white = Imath::V3f(1, 1, 1) * Imf::RGBtoXYZ(c, 1), weights = Imf::RgbaYca::computeYw(c);
    return area_of(c) > 1e-4f && std::isfinite(white.length2()) && std::isfinite(weights.length2());
  } catch (const std::exception&) {
    return false;
  }
}

/// The file's primaries and white.
Imf::Chromaticities chromaticities_of(const std::filesystem::path& file, const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return {};  // those of Rec.709
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  if (!span_colours(c))
    cannot_read(file, "found an attribute chromaticities whose primaries and white span no colours");
  return c;
}

/// The linear Bradford transform of XYZ that turns one white into another. (Row vectors, as Imath has them.)
Imath::M44f adaptation(const Imath::V2f& from, const Imath::V2f& to) {
  const Imath::M44f cones(0.8951f, -0.7502f, 0.0389f, 0, 0.2664f, 1.7135f, -0.0685f, 0, -0.1614f, 0.0367f, 1.0296f, 0,
                          0, 0, 0, 1);
  const auto cones_of = [&cones](const Imath::V2f& white) {
    return Imath::V3f(white.x / white.y, 1, (1 - white.x - white.y) / white.y) * cones;
  };
  Imath::M44f scale;
  scale.setScale(cones_of(to) / cones_of(from));
  return cones * scale * cones.inverse();
}

/// Converts linear RGB, 3 floats a pixel, by the attribute "chromaticities" to the Rec.709 RGB of the same CIE XYZ.
/// The white of the file is converted like any other colour, unless the attribute "adoptedNeutral" says which
/// chromaticity is to look neutral: that one becomes the white of Rec.709, by a linear Bradford transform. Values of
/// files in Rec.709 stay as they are, bit for bit. Throws ImageFileError for chromaticities that span no colours.
void convert_to_rec709(const std::filesystem::path& file, const Imf::Header& header, std::vector<float>& rgb) {
  const Imf::Chromaticities from = chromaticities_of(file, header), rec709;
  const bool has_neutral = Imf::hasAdoptedNeutral(header);
  const Imath::V2f neutral = has_neutral ? Imf::adoptedNeutral(header) : rec709.white;
  if (has_neutral && !(neutral.x > 0 && neutral.y > 0 && neutral.x + neutral.y <= 1))
    cannot_read(file, "found an attribute adoptedNeutral that is no chromaticity");
  if (near(from, rec709) && near(neutral, rec709.white)) return;
  Imath::M44f matrix = Imf::RGBtoXYZ(from, 1);
  if (!near(neutral, rec709.white)) matrix = matrix * adaptation(neutral, rec709.white);
  matrix = matrix * Imf::XYZtoRGB(rec709, 1);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const Imath::V3f converted = Imath::V3f(rgb[i], rgb[i + 1], rgb[i + 2]) * matrix;
    for (int k = 0; k < 3; ++k) rgb[i + static_cast<std::size_t>(k)] = converted[k];
  }
}

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

/// Reads a layer as the file has it.
struct LayerReader {
  const std::filesystem::path& file;
  Imf::MultiPartInputFile& exr;
  const ExrLayer layer;
  const Imf::Header& header = exr.header(layer.part);
  LinearImage image = empty_picture(file, header);

  /// How many columns and rows of pixels share a value of a channel.
  std::pair<int, int> sampling_of(const std::string& name) const {
    const Imf::Channel& channel = header.channels()[name];
    return {channel.xSampling, channel.ySampling};
  }
  void check_sampling(const std::string& name) const {
    const auto [x, y] = sampling_of(name);
    if (x == 1 && y == 1) return;
    cannot_read(file, "found one value for every " + std::to_string(x) + " x " + std::to_string(y) +
                          " pixels in channel " + name + ", expected one for each pixel");
  }
  /// Channels that have a value for each pixel, as red, green and blue; or one as all three.
  void read_channels() {
    ExrTarget target{{}, header.dataWindow()};
    float* rgb = image.rgb.data();
    for (std::size_t i = 0; i < layer.channels.size(); ++i) {
      check_sampling(layer.channels[i]);
      target.add(layer.channels[i], Imf::FLOAT, rgb + i, 3 * sizeof(float));
    }
    target.read(exr, layer.part);
    for (std::size_t i = 0; layer.channels.size() == 1 && i < image.rgb.size(); i += 3)
      rgb[i + 1] = rgb[i + 2] = rgb[i];
  }
  /// Luminance and chroma with a value for each pixel, by the definitions in OpenEXR's ImfRgbaYca.h.
  void read_whole_chroma() {
    read_channels();
    const Imath::V3f weights = Imf::RgbaYca::computeYw(chromaticities_of(file, header));
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      const float y = image.rgb[i], red = (image.rgb[i + 1] + 1) * y, blue = (image.rgb[i + 2] + 1) * y;
      image.rgb[i] = red, image.rgb[i + 1] = (y - red * weights.x - blue * weights.z) / weights.y,
      image.rgb[i + 2] = blue;
    }
  }
  /// Luminance for each pixel and chroma for every 2 x 2, by OpenEXR's own filter, in its 16 bits a value.
  void read_half_chroma() {
    check_sampling(layer.channels[0]);
    chromaticities_of(file, header);  // refuses those that cannot be
    if (exr.parts() > 1)
      cannot_read(file, "found luminance and chroma of 2 x 2 pixels in a file of several parts, expected one part");
    Imf::RgbaInputFile chroma(file.string().c_str(), layer.prefix);
    const Region& data = image.frame->data;
    std::vector<Imf::Rgba> row(static_cast<std::size_t>(image.width));
    chroma.setFrameBuffer(Imf::ComputeBasePointer(row.data(), {data.x0, 0}, image.width), 1, 0);
    auto* to = image.rgb.data();
    for (int y = data.y0; y < data.y1; ++y) {
      chroma.readPixels(y);
      for (const Imf::Rgba& pixel : row)
        for (const float value : {pixel.r, pixel.g, pixel.b}) *to++ = value;
    }
  }
  void read() {
    if (layer.colour != ExrColour::luminance_chroma) return read_channels();
    const std::pair half{2, 2};
    if (sampling_of(layer.channels[1]) == half && sampling_of(layer.channels[2]) == half) return read_half_chroma();
    read_whole_chroma();
  }
};

}  // namespace

LinearImage read_exr(const std::filesystem::path& file, const std::optional<std::string>& name) {
  return with_exr(file, [&](Imf::MultiPartInputFile& exr) {
    LayerReader reader{file, exr, find_exr_layer(file, exr, name)};
    reader.read();
    if (reader.layer.colour == ExrColour::luminance_chroma || reader.layer.colour == ExrColour::rgb)
      convert_to_rec709(file, reader.header, reader.image.rgb);
    return std::move(reader.image);
  });
}

}  // namespace tyndall

#endif

#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr_open.h"

#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfHeader.h>
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

}  // namespace

Imath::V3f luminance_weights(const std::filesystem::path& file, const Imf::Header& header) {
  return Imf::RgbaYca::computeYw(chromaticities_of(file, header));
}

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

}  // namespace tyndall

#endif

#include "app/check/statistics.h"
#include "core/image/tonemap.h"

namespace tyndall {
namespace {

float light_of(TransferCurve curve, float number) {
  if (curve == TransferCurve::srgb) return srgb_decode(number);
  const float power = curve == TransferCurve::power22        ? 2.2f
                      : curve == TransferCurve::gamma2       ? 2
                      : curve == TransferCurve::gamma2_twice ? 4
                                                             : 1;
  return power == 1 ? number : std::pow(number, power);
}

/// Half of the light between the numbers one step above and below, at least that of a dark grey: in black no step can
/// be seen.
float tolerance_of(TransferCurve curve, float number, float step) {
  if (curve == TransferCurve::light) return step * std::max(std::abs(number), 0.02f);
  const float middle = std::clamp(number, 0.02f, 1 - step);
  return 0.5f * (light_of(curve, middle + step) - light_of(curve, middle - step));
}

}  // namespace

std::vector<Reading> readings_of(bool coded, bool right) {
  std::vector<TransferCurve> curves{TransferCurve::light};
  if (coded)
    curves = {TransferCurve::gamma2, TransferCurve::srgb, TransferCurve::power22, TransferCurve::none,
              TransferCurve::gamma2_twice};
  std::vector<Reading> readings;
  for (const bool swapped : {false, true})
    for (const bool upside_down : {false, true})
      for (const bool mirrored : {false, true})
        for (const TransferCurve curve : curves)
          if (const Reading reading{curve, upside_down, mirrored, swapped}; reading.is_right() == right)
            readings.push_back(reading);
  return readings;
}

PictureNumbers numbers_of(const PictureFile& picture) {
  PictureNumbers result{picture.image.width, picture.image.height, picture.image.rgb};
  result.coded = picture.bits < 32;
  if (picture.kind == ImageKind::jpeg) result.step = 3 / 256.0f;
  if (!result.coded) {
    result.step = picture.kind == ImageKind::hdr ? 1 / 128.0f : 1 / 500.0f;
    return result;
  }
  // The books' programs round down, to one of 256 steps.
  const bool rounded_down = picture.kind == ImageKind::ppm && picture.bits == 8;
  for (float& value : result.numbers) {
    const float number = std::clamp(srgb_encode(value), 0.0f, 1.0f);
    value = rounded_down ? (std::round(255 * number) + 0.5f) / 256 : number;
  }
  return result;
}

ReadPixels read_pixels(const PictureNumbers& picture, const Lattice& lattice, const Reading& reading) {
  ReadPixels pixels;
  for (int y = 0; y < picture.height; y += lattice.step)
    for (int x = 0; x < picture.width; x += lattice.step) {
      const int column = reading.mirrored ? picture.width - 1 - x : x;
      const int row = reading.upside_down ? picture.height - 1 - y : y;
      const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(column));
      for (std::size_t c = 0; c < 3; ++c) {
        const float number = picture.numbers[at + (reading.swapped ? 2 - c : c)];
        pixels.light.push_back(static_cast<double>(light_of(reading.curve, number)));
        pixels.tolerance.push_back(static_cast<double>(tolerance_of(reading.curve, number, picture.step)));
      }
    }
  return pixels;
}

}  // namespace tyndall

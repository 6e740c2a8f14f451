#pragma once
#include "core/base/choice.h"
#include "core/base/vec.h"

#include <cstdint>
#include <optional>
#include <vector>

/// Turns linear light into the 8-bit values of a screen.
namespace tyndall {

/// How light beyond what a screen can show is treated.
enum class ToneMap { srgb, aces, agx };

constexpr Label label(ToneMap map) {
  switch (map) {
    case ToneMap::srgb:
      return {"srgb", "clipped"};
    case ToneMap::aces:
      return {"aces", "a film's shoulder"};
    case ToneMap::agx:
      return {"agx", "AgX (approximation): bright colours fade to white"};
  }
  return {};
}

/// Contrast of AgX. x: stops above the darkest, as a fraction of all 16.5, in [0, 1]; the result is a screen's code
/// value, gamma 2.2. J. Smith's sigmoid with the numbers of Sobotka's table AgX_Default_Contrast: slope 2 at 0.18,
/// which is at 20/33, from there powers 3 downwards and 13/4 upwards to (0, 0) and (1, 1); in closed form after
/// github.com/bWFuanVzYWth/AgX.
float agx_contrast(float x);

/// sRGB's transfer function for linear values in [0, 1], and back (IEC 61966-2-1).
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// The pixel of the full image at a picture's top left, so that a region is dithered like the same part of the whole.
struct DitherOrigin {
  int x = 0, y = 0;
};

/// 8-bit sRGB of curve(linear · 2^exposure), clipped to [0, 1]; NaN gives 0. rgb: 3 floats a pixel. The curves are kept
/// as short straight pieces, within 1/200 of a step of 8 bits.
/// `aces`: the fit by K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015.
/// `agx`: T. Sobotka, AgX (github.com/sobotka/AgX), base contrast, without the looks and the later work in wider
/// gamuts, which is why it is called an approximation. It shows 0.18 at half of the screen's scale (code value 0.5),
/// black from ten stops below that, white from 6.5 stops above.
/// dither: rounds by a fixed pattern instead of to the nearest, so that smooth shades do not become bands. Each value
/// moves by less than half a step before it is rounded, so that what 8 bits can show exactly stays exact, and the mean
/// over 8 x 8 pixels of a flat area is within 1/128 of a step. width: pixels a row, which only dithering needs.
std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneMap curve, int width = 0,
                                   std::optional<DitherOrigin> dither = {});

/// The bytes that the programs of the "Ray Tracing in One Weekend" books write (4th edition, color.h): of
/// v = curve(linear · 2^exposure), floor(256 · min(sqrt(v), 0.999)); NaN and what is below 0 give 0. They are not
/// dithered.
std::vector<std::uint8_t> gamma2_bytes(const std::vector<float>& rgb, double exposure, ToneMap curve);

/// The same as tone_map() for a texture: `rgba` has 4 floats a pixel, of which the last is not read, `bytes`
/// gets 4, the last is 255.
void tone_map_rgba(const std::vector<float>& rgba, double exposure, ToneMap curve, int width, bool dither,
                   std::vector<std::uint8_t>& bytes);

}  // namespace tyndall

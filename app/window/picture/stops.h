#pragma once
#include <array>

/// The colours of the view that shows luminance in stops: one for each, from middle grey.
namespace tyndall {

/// A colour as the screen shows it, in [0, 1].
struct ScreenColour {
  float r = 0, g = 0, b = 0;
};

/// Bands from -6 to +6: each holds what is nearer to its stop than to the next; the first and the last hold all that is
/// darker or brighter. Cold below middle grey, warm above, grey at it; the brightest is white.
inline constexpr std::array<ScreenColour, 13> stop_colours = {{{0.10f, 0.04f, 0.20f},
                                                               {0.22f, 0.08f, 0.45f},
                                                               {0.20f, 0.20f, 0.70f},
                                                               {0.12f, 0.42f, 0.80f},
                                                               {0.10f, 0.60f, 0.66f},
                                                               {0.16f, 0.66f, 0.40f},
                                                               {0.50f, 0.50f, 0.50f},
                                                               {0.62f, 0.76f, 0.24f},
                                                               {0.90f, 0.84f, 0.20f},
                                                               {0.96f, 0.64f, 0.16f},
                                                               {0.94f, 0.38f, 0.16f},
                                                               {0.84f, 0.14f, 0.18f},
                                                               {1.00f, 1.00f, 1.00f}}};
inline constexpr int darkest_stop = -6, brightest_stop = darkest_stop + static_cast<int>(stop_colours.size()) - 1;
inline constexpr float middle_grey = 0.18f;

}  // namespace tyndall

#pragma once
#include <imgui.h>

/// Colours, sizes and fonts of the window.
namespace tyndall {

/// The palette: scattered blue and transmitted amber, as in Tyndall's tank of milky water; the rest is neutral so that
/// the picture keeps its colours.
struct Tone {
  float x, y, z, w;
  operator ImVec4() const { return {x, y, z, w}; }
};
namespace palette {
inline constexpr Tone ink{0.086f, 0.094f, 0.106f, 1}, panel{0.118f, 0.129f, 0.145f, 1},
    field{0.165f, 0.180f, 0.204f, 1}, field_hovered{0.21f, 0.23f, 0.26f, 1}, field_active{0.24f, 0.27f, 0.30f, 1},
    text{0.90f, 0.91f, 0.93f, 1}, dim{0.56f, 0.60f, 0.65f, 1}, blue{0.36f, 0.65f, 0.92f, 1},
    amber{0.96f, 0.64f, 0.31f, 1}, red{0.94f, 0.42f, 0.38f, 1}, line{1, 1, 1, 0.07f};
}  // namespace palette

/// A colour for draw lists; alpha scales its own.
ImU32 shade(Tone colour, float alpha = 1);

/// Null fonts are the default one.
struct Fonts {
  ImFont *body = nullptr, *small = nullptr, *strong = nullptr, *mono = nullptr;
};

/// Sets colours and sizes. scale: window units per unit of the design (2 on a screen of twice the density).
void set_style(float scale);

/// Loads the fonts into the atlas: Roboto and JetBrains Mono where they are installed, else the built-in one.
/// pixels: font pixels per unit of the design; scale: as above.
Fonts load_fonts(float pixels, float scale);

}  // namespace tyndall

#pragma once
#include <imgui.h>

#include <set>
#include <string>

/// Colours and sizes of the window.
namespace tyndall {

/// A colour.
struct Tone {
  float x, y, z, w;
  operator ImVec4() const { return {x, y, z, w}; }
};

/// Light letters on dark panels, or dark ones on light panels.
enum class Theme { dark, light };

/// A colour of the theme that was set last, see set_style().
struct ThemeTone {
  Tone dark, light;
  operator Tone() const;
  operator ImVec4() const { return Tone(*this); }
};

/// The palette: scattered blue and transmitted amber, as in Tyndall's tank of milky water; the rest is neutral so that
/// the picture keeps its colours.
namespace palette {
inline constexpr ThemeTone ink{{0.086f, 0.094f, 0.106f, 1}, {0.855f, 0.862f, 0.875f, 1}},
    panel{{0.118f, 0.129f, 0.145f, 1}, {0.945f, 0.949f, 0.957f, 1}},
    field{{0.165f, 0.180f, 0.204f, 1}, {0.875f, 0.885f, 0.902f, 1}},
    field_hovered{{0.21f, 0.23f, 0.26f, 1}, {0.835f, 0.848f, 0.870f, 1}},
    field_active{{0.24f, 0.27f, 0.30f, 1}, {0.79f, 0.81f, 0.84f, 1}},
    text{{0.90f, 0.91f, 0.93f, 1}, {0.12f, 0.13f, 0.15f, 1}}, dim{{0.56f, 0.60f, 0.65f, 1}, {0.38f, 0.41f, 0.45f, 1}},
    faint{{0.42f, 0.45f, 0.49f, 1}, {0.60f, 0.63f, 0.67f, 1}},
    chosen{{0.24f, 0.40f, 0.56f, 1}, {0.64f, 0.79f, 0.94f, 1}},
    blue{{0.36f, 0.65f, 0.92f, 1}, {0.09f, 0.42f, 0.74f, 1}}, amber{{0.96f, 0.64f, 0.31f, 1}, {0.76f, 0.39f, 0.02f, 1}},
    red{{0.94f, 0.42f, 0.38f, 1}, {0.77f, 0.19f, 0.15f, 1}}, line{{1, 1, 1, 0.07f}, {0, 0, 0, 0.10f}},
    veil{{1, 1, 1, 1}, {0, 0, 0, 1}};
}  // namespace palette

/// A colour for draw lists; alpha scales its own.
ImU32 shade(Tone colour, float alpha = 1);

/// Sets colours and sizes. scale: window units per unit of the design (2 on a screen of twice the density).
void set_style(float scale, Theme theme = Theme::dark);

/// Null fonts are the default one.
struct Fonts {
  ImFont *body = nullptr, *small = nullptr, *strong = nullptr, *mono = nullptr;
};

/// Characters beyond those that are always loaded (Latin, Greek, Cyrillic and the signs that the panels use).
using Characters = std::set<ImWchar>;
/// Adds to `more` the characters of a text, UTF-8, that are not always loaded. Returns whether there were new ones.
bool add_characters(const std::string& text, Characters& more);

/// Loads the fonts into the atlas: Roboto and JetBrains Mono where they are installed, else the built-in one. `more`
/// come from other installed fonts that have them (Chinese, Japanese and Korean ones first); what no font has is shown
/// as "?". pixels: font pixels per unit of the design; scale: window units per unit of the design.
Fonts load_fonts(float pixels, float scale, const Characters& more = {});

}  // namespace tyndall

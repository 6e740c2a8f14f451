#pragma once
#include <imgui.h>

#include <set>
#include <string>

/// The fonts of the window.
namespace tyndall {

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

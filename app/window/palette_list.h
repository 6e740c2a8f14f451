#pragma once
#include "app/window/document/document.h"
#include "app/window/menus/menu.h"

#include <string>
#include <vector>

/// All that the palette offers.
namespace tyndall {

/// Commands, rows of the column, parts of the column and scenes. Rows that the column does not show while this
/// object is selected (an empty path: nothing is) come after those that it does, and say what to do first. scenes: what
/// can be opened, for load_scene.
std::vector<PaletteItem> palette_items(const Scene& scene, const ObjectPath& selected,
                                       const std::vector<std::string>& scenes);

}  // namespace tyndall

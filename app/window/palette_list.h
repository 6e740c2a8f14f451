#pragma once
#include "app/window/menus/menu.h"
#include "app/window/menus/row_list.h"

#include <string>
#include <vector>

/// All that the palette offers.
namespace tyndall {

/// Commands, rows of the column, sections of the column and scenes. scenes: what can be opened, for load_scene.
std::vector<PaletteItem> palette_items(const std::vector<ListedRow>& rows, const std::vector<std::string>& scenes);

}  // namespace tyndall

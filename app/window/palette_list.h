#pragma once
#include "app/window/menus/menu.h"

#include <string>
#include <vector>

/// All that the palette offers, with the words by which users of other programs know it.
namespace tyndall {

/// A row of the column, or, where its label is empty, a section.
struct ListedRow {
  RowEntry row;
  std::string missing;  ///< what to do first, as the column does not show it: "select fog first"; "": it does
};

/// The rows that the column draws, then those that it has at other times. Of rows of one part with the same label there
/// is one: the first, to which the column goes.
std::vector<ListedRow> listed_rows(const std::vector<RowEntry>& drawn);

/// Commands, rows of the column, sections of the column and scenes. scenes: what can be opened, for load_scene.
std::vector<PaletteItem> palette_items(const std::vector<ListedRow>& rows, const std::vector<std::string>& scenes);

}  // namespace tyndall

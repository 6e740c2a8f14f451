#pragma once
#include "app/window/panels/widgets.h"

#include <string>
#include <vector>

/// The rows of the column to which the palette leads, with the words by which users of other programs know them.
namespace tyndall {

/// A row of the column, or, where its label is empty, a section.
struct ListedRow {
  RowEntry row;
  std::string missing;  ///< what to do first, as the column does not show it: "select fog first"; "": it does
};

/// The rows that the column draws, then those that it has at other times. Of rows of one part with the same label there
/// is one: the first, to which the column goes.
std::vector<ListedRow> listed_rows(const std::vector<RowEntry>& drawn);

}  // namespace tyndall

#pragma once
#include "app/window/tools/selection.h"

#include <span>
#include <string>

/// The rows of the column that the palette leads to, with the words by which users of other programs know them.
namespace tyndall {

/// A row of the column, or, where its label is empty, a section that no tab leads to.
struct RowEntry {
  std::string part;     ///< of the column: "Object", "Camera", "Image", "Render", "Background", "Histogram", "Window"
  std::string label;    ///< as the column shows it: "Refractive index"
  std::string also;     ///< other words for it, separated by ", "
  std::string missing;  ///< what to do where the column does not show it: "select fog first"; "": it always does
};

/// All of them: a row for each field of what the panels show, in the order of the column.
std::span<const RowEntry> row_entries();

/// Whose row it is while this object is selected (an empty path: nothing is): for rows of objects the title of the
/// first object that has it, for others their part. Empty: the column does not show it.
std::string owner_of(const RowEntry& row, const Scene& scene, const ObjectPath& selected);

}  // namespace tyndall

#pragma once
#include "app/window/tools/selection.h"

#include <string>
#include <vector>

/// The rows of the column that the palette leads to, with the words by which users of other programs know them.
namespace tyndall {

/// A row of the column, or, where its label is empty, a section that no tab leads to.
struct RowEntry {
  std::string part;      ///< of the column: "Object", "Camera", "Image", "Render", "Background", "Histogram", "Window"
  std::string label;     ///< as the column shows it: "Refractive index"
  std::string synonyms;  ///< other words for it, separated by ", "
  std::string owner;     ///< whose it is: the title of an object, else its part
  std::string missing;   ///< what to do first, as the column does not show it: "select fog first"; "": it does
};

/// The rows that the column has while this object is selected (an empty path: nothing is), in its order, then those
/// that it has at other times. Of rows of one part with the same label there is one: the first, to which the column
/// goes.
std::vector<RowEntry> row_entries(const Scene& scene, const ObjectPath& selected);

}  // namespace tyndall

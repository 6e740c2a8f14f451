#pragma once
#include "app/window/panels/widgets.h"

/// The wheel of the mouse over lists within a column that scrolls itself.
namespace tyndall {

/// To be called within the window of a list that scrolls (ImGuiWindowFlags_NoScrollWithMouse): scrolls it when the
/// mouse is over it, unless the column was being scrolled a moment ago, or the list is at its end.
void scroll_list(Ui& ui);
/// To be called at the end of the column's window: scrolls it unless a list did.
void scroll_column(Ui& ui);

}  // namespace tyndall

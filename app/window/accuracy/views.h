#pragma once
#include "app/window/accuracy/comparison.h"
#include "core/render/frame.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

/// The views that the window can show in the picture's place, in the order of their buttons.
namespace tyndall {

/// Something that the window can show in the picture's place.
struct ViewEntry {
  const char* name;                   ///< on its button
  View view = View::beauty;           ///< what the renderer draws
  ErrorView error = ErrorView::none;  ///< a picture of differences over it; it needs something to measure against
  const char* meaning = "";           ///< grey line beneath the buttons
};

inline constexpr ViewEntry error_views[] = {
    {"error", View::beauty, ErrorView::error, "black: no error; white: 100 % or more"},
    {"FLIP", View::beauty, ErrorView::flip, "differences that an eye sees; bright: large ones"},
};

/// A view is known by its number: first come the renderer's views, then those of errors. The buttons, the keys 1, 2, 3,
/// … and the help table are loops over these numbers. So a new view is named beside View in core/render/frame.h and
/// drawn in core/render, or it is named above and compared in comparison.cpp; nothing else knows of it.
inline constexpr int view_count = count_of<View>() + static_cast<int>(std::size(error_views));
/// How many views have a key, the digits 1 to 9. Those after the ninth have only their button.
inline constexpr int keyed_views = std::min(view_count, 9);

inline ViewEntry view_entry(int number) {
  constexpr int drawn = count_of<View>();
  if (number >= drawn) return error_views[static_cast<std::size_t>(number - drawn)];
  const View view = static_cast<View>(number);
  return {name_of(view), view, ErrorView::none, word(view).help};
}

/// Whether a view shows differences from a reference or from the other half.
inline bool shows_errors(int number) { return view_entry(number).error != ErrorView::none; }

/// The number of a view; that of beauty for a name that no view has.
inline int view_named(std::string_view name) {
  for (int k = 0; k < view_count; ++k)
    if (name == view_entry(k).name) return k;
  return 0;
}

}  // namespace tyndall

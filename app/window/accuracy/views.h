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
  const char* words;                  ///< by which the palette finds it, too
  View view = View::beauty;           ///< what the renderer draws
  ErrorView error = ErrorView::none;  ///< a picture of differences over it; it needs something to measure against
  const char* meaning = "";           ///< grey line beneath the buttons
  bool stops = false;                 ///< the picture's luminance in colours, a stop each: see stop_colours
};

constexpr ViewEntry entry_of(View view, const char* words = "") {
  return {label(view).name, words, view, ErrorView::none, label(view).help};
}

inline constexpr ViewEntry view_entries[] = {
    entry_of(View::beauty, "combined, rgb"),
    entry_of(View::albedo),
    entry_of(View::normal, "normals"),
    entry_of(View::depth, "depth buffer, z buffer, distance"),
    entry_of(View::noise, "variance map, convergence"),
    entry_of(View::samples, "sample map"),
    entry_of(View::cost, "heat map of time, time per pixel"),
    {"error", "difference, error map", View::beauty, ErrorView::error, "black: no error; white: 100 % or more"},
    {"FLIP", "perceptual difference", View::beauty, ErrorView::flip,
     "differences that an eye sees; bright: large ones"},
    entry_of(View::object, "object id, cryptomatte"),
    {"false colour", "false color, heat map, zebra", View::beauty, ErrorView::none,
     "luminance in stops from middle grey, as exposed", true},
};

/// A view is known by its number in the list above. The buttons, the keys 1, 2, 3, … and the help table are loops over
/// these numbers. So a new view is named beside View in core/render/frame.h and drawn in core/render, or it is compared
/// in comparison.cpp, and listed above, best at the end, as the digits are known by heart; nothing else knows of it.
inline constexpr int view_count = static_cast<int>(std::size(view_entries));
/// How many views have a key, the digits 1 to 9. Those after the ninth have only their button.
inline constexpr int keyed_views = std::min(view_count, 9);

inline ViewEntry view_entry(int number) { return view_entries[static_cast<std::size_t>(number)]; }

/// Whether a view shows differences from a reference or from the other half.
inline bool shows_errors(int number) { return view_entry(number).error != ErrorView::none; }

/// Whether a view shows the scene itself, or how it is rendered; the others are drawn from the samples.
inline bool is_view_of_scene(int number) {
  const View view = view_entry(number).view;
  return view != View::beauty && view != View::noise && view != View::samples;
}

/// The number of a view; that of beauty for a name that no view has.
inline int view_named(std::string_view name) {
  for (int k = 0; k < view_count; ++k)
    if (name == view_entry(k).name) return k;
  return 0;
}

}  // namespace tyndall

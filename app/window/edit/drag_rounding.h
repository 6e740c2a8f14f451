#pragma once
#include "core/base/vec.h"

/// This room edits the objects and materials of a scene: a scene goes in, the scene changes, and nothing is drawn.
/// Every function leaves numbers that a person would write.
namespace tyndall {

/// A step that numbers are rounded to: multiple * 10^exponent, multiple being 1, 2 or 5.
struct DragRounding {
  int multiple = 1, exponent = 0;
  double size() const;
};
/// The largest power of ten that is at most `size` > 0.
DragRounding decimal_below(double size);
/// The largest of 1, 2 or 5 times a power of ten that is at most `size` > 0.
DragRounding nice_below(double size);

/// The multiple of the grain that is nearest; it prints short.
double rounded(double value, DragRounding drag_rounding);
Vec3d rounded(Vec3d v, DragRounding drag_rounding);
/// Twelve significant digits: 0.1 + 0.2 becomes 0.3.
double without_noise(double value);
Vec3d without_noise(Vec3d v);

}  // namespace tyndall

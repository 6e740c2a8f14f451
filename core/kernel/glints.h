#pragma once
#include "core/base/random.h"

#include <vector>

/// Glints: what the camera sees of a small lamp, directly or by one ball, flat mirror or pane. A glint may fill so
/// little of its pixel that samples which are spread evenly over the pixel seldom hit it, and each that does is a
/// bright speck. So half of the samples of such a pixel are drawn within boxes around its glints, and all of its
/// samples are weighed by the density of their place. That is exact wherever the boxes lie: they only have to be there.
namespace tyndall {

/// A box around a glint, or the part of it in one pixel.
struct Glint {
  float x, y;                      ///< column and row of the pixel
  float left, top, width, height;  ///< of the box, from the pixel's upper left corner, in pixels
  float begin, end;                ///< random numbers in [begin, end) choose this box
  float density;                   ///< what the box adds to the density of its places: (end - begin) / area
};

/// Share of the samples of a pixel with glints that are drawn within their boxes.
inline constexpr float glint_share = 0.5f;

/// Glints one after another in memory.
struct Glints {
  const Glint *first, *last;
};

/// Of glints sorted by row, those in the rows [begin, end).
TYNDALL_INLINE Glints glints_in_rows(Glints all, int begin, int end) {
  while (all.first != all.last && all.first->y < static_cast<float>(begin)) ++all.first;
  while (all.first != all.last && (all.last - 1)->y >= static_cast<float>(end)) --all.last;
  return all;
}

struct SceneView;

/// The glints of the lamps that chains look for, as the camera sees them while nothing is in the way; sorted by row.
/// Only of lamps and balls that rest, for a camera without a lens, and only where one fills less than half of a pixel.
std::vector<Glint> find_glints(const SceneView& scene);

/// Moves the places of samples, each in its own pixel (x, y), towards the glints there. at: points in the unit square,
/// evenly distributed on entry. Returns the weight of each sample: 1 / density of its place.
template <class F>
TYNDALL_INLINE F aim_at_glints(Glints glints, F x, F y, Pair<F>& at) {
  const Pair<F> even = at;
  const auto in_pixel = [&](const Glint& g) { return mask_and(equal(x, F(g.x)), equal(y, F(g.y))); };
  const auto drawn = [&](const Glint& g) {
    return mask_and(in_pixel(g), mask_and(less_equal(F(g.begin), even.x), less(even.x, F(g.end))));
  };
  F density = F(1.0f);
  for (const Glint* g = glints.first; g != glints.last; ++g) {
    const auto here = in_pixel(*g);
    if (!any(here)) continue;
    density = select(here, F(1.0f - glint_share), density);
    const F along_x = (even.x - F(g->begin)) * F(1.0f / (g->end - g->begin));
    const auto whole = mask_and(here, less_equal(F(glint_share), even.x));
    at.x = select(whole, (even.x - F(glint_share)) * F(1.0f / (1.0f - glint_share)), at.x);
    const auto chosen = drawn(*g);
    at.x = select(chosen, mul_add(along_x, F(g->width), F(g->left)), at.x);
    at.y = select(chosen, mul_add(even.y, F(g->height), F(g->top)), at.y);
  }
  for (const Glint* g = glints.first; g != glints.last; ++g) {
    const F right = F(g->left + g->width), bottom = F(g->top + g->height);
    const auto across = mask_and(less_equal(F(g->left), at.x), less(at.x, right));
    const auto down = mask_and(less_equal(F(g->top), at.y), less(at.y, bottom));
    const auto inside = mask_or(drawn(*g), mask_and(in_pixel(*g), mask_and(across, down)));
    density = select(inside, density + F(g->density), density);
  }
  return F(1.0f) / density;
}

}  // namespace tyndall

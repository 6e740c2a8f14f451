#pragma once
#include "core/compile/render_scene.h"

#include <algorithm>

/// Subpixel lights: images of a small light in the camera, seen directly, by one sphere, flat mirror or slab, or by
/// metal of little fuzz. Such an image may fill so little of its pixel that samples spread evenly over the pixel seldom
/// hit it, and each hit is a bright speck. So half of the samples of such a pixel are drawn within boxes around its
/// subpixel lights, and all of its samples are weighted by the pdf of their place. That is exact wherever the boxes
/// lie.
namespace tyndall {

/// A box around a subpixel light, or the part of it in one pixel.
struct SubpixelLight {
  float x, y;                      ///< column and row of the pixel
  float left, top, width, height;  ///< of the box, from the pixel's upper left corner, in pixels
  float begin, end;                ///< random numbers in [begin, end) choose this box
  float pdf;                       ///< the box's part of the pdf of places within it: (end - begin) / area
  std::int32_t route;              ///< see pack_route(); 0: no reflections by glass
};

/// Events that samples in a box still have to meet on the path to the light: `reflections` by glass and `crossings` of
/// its surface, each at most 15. Packed into one integer, so that it can wait in a lane; 0 stands for no route.
inline constexpr std::int32_t pack_route(std::int32_t reflections, std::int32_t crossings) {
  return 256 + 16 * reflections + crossings;
}
template <class F>
struct GlassRoute {
  IntOf<F> packed;
  TYNDALL_INLINE MaskOf<F> is_set() const { return less(IntOf<F>(0), packed); }
  TYNDALL_INLINE IntOf<F> reflections() const { return as_int(shift_right<4>(as_uint(packed))) & IntOf<F>(15); }
  TYNDALL_INLINE IntOf<F> crossings() const { return packed & IntOf<F>(15); }
  /// Removes an event from the route in the lanes `here`: a reflection in the lanes `reflects`, else a crossing.
  TYNDALL_INLINE void count(MaskOf<F> here, MaskOf<F> reflects) {
    const IntOf<F> none = IntOf<F>(0), one = IntOf<F>(1);
    const IntOf<F> reflected = select(less(none, reflections()), packed - IntOf<F>(16), packed);
    const IntOf<F> crossed = select(less(none, crossings()), packed - one, packed);
    packed = select(here, select(reflects, reflected, crossed), packed);
  }
};

/// How strongly the events of samples in a box are steered: an event's probability is this fraction of the route's and
/// the rest of the glass's own, and the sample is weighted accordingly. The glass alone sends few samples along a path
/// with several inner reflections, each a bright speck. The rest finds light that arrives by other paths.
inline constexpr float subpixel_light_steering = 0.75f;

/// Fraction of the samples of a pixel with subpixel lights that are drawn within their boxes.
inline constexpr float subpixel_light_fraction = 0.5f;

/// Subpixel lights that are consecutive in memory.
struct SubpixelLights {
  const SubpixelLight *first, *last;
};

/// Returns those in the rows [begin, end). all: sorted by row.
TYNDALL_INLINE SubpixelLights subpixel_lights_in_rows(const Column<SubpixelLight>& all, int begin, int end) {
  SubpixelLights in{all, all + all.count()};
  while (in.first != in.last && in.first->y < static_cast<float>(begin)) ++in.first;
  while (in.first != in.last && (in.last - 1)->y >= static_cast<float>(end)) --in.last;
  return in;
}

/// What samples in pixels with subpixel lights carry.
template <class F>
struct AtSubpixelLights {
  F weight;             ///< 1 / pdf of the sample's place
  GlassRoute<F> route;  ///< of the box in which the sample was drawn; else the one with most reflections there
};

/// Moves the places of samples, each in its own pixel (x, y), into boxes around the subpixel lights there. at: points
/// in the unit square, uniform on entry.
template <class F>
TYNDALL_INLINE AtSubpixelLights<F> aim_at_subpixel_lights(SubpixelLights subpixel_lights, F x, F y, Pair<F>& at) {
  const Pair<F> even = at;
  const auto in_pixel = [&](const SubpixelLight& g) { return mask_and(equal(x, F(g.x)), equal(y, F(g.y))); };
  const auto drawn = [&](const SubpixelLight& g) {
    return mask_and(in_pixel(g), mask_and(less_equal(F(g.begin), even.x), less(even.x, F(g.end))));
  };
  F pdf = F(1.0f);
  IntOf<F> route = IntOf<F>(0);
  for (const SubpixelLight* g = subpixel_lights.first; g != subpixel_lights.last; ++g) {
    const auto here = in_pixel(*g);
    if (!any(here)) continue;
    pdf = select(here, F(1.0f - subpixel_light_fraction), pdf);
    const F along_x = (even.x - F(g->begin)) * F(1.0f / (g->end - g->begin));
    const auto whole = mask_and(here, less_equal(F(subpixel_light_fraction), even.x));
    at.x = select(whole, (even.x - F(subpixel_light_fraction)) * F(1.0f / (1.0f - subpixel_light_fraction)), at.x);
    const auto chosen = drawn(*g);
    at.x = select(chosen, mul_add(along_x, F(g->width), F(g->left)), at.x);
    at.y = select(chosen, mul_add(even.y, F(g->height), F(g->top)), at.y);
    route = select(chosen, IntOf<F>(g->route), route);
  }
  const auto by_chance = less_equal(F(subpixel_light_fraction), even.x);
  for (const SubpixelLight* g = subpixel_lights.first; g != subpixel_lights.last; ++g) {
    const auto across = mask_and(less_equal(F(g->left), at.x), less(at.x, F(g->left + g->width)));
    const auto down = mask_and(less_equal(F(g->top), at.y), less(at.y, F(g->top + g->height)));
    const auto inside = mask_or(drawn(*g), mask_and(in_pixel(*g), mask_and(across, down)));
    pdf = select(inside, pdf + F(g->pdf), pdf);
    const IntOf<F> its = IntOf<F>(g->route);
    route = select(mask_and(mask_and(inside, by_chance), less(route, its)), its, route);
  }
  return {F(1.0f) / pdf, {route}};
}

/// A part of the picture in which the camera sees a small light, in pixels from the picture's upper left corner.
struct PictureBox {
  float left = 1e30f, top = 1e30f, right = -1e30f, bottom = -1e30f;
  std::int32_t route = 0;  ///< see SubpixelLight
  float throughput = 0;    ///< fraction of radiance from the light's middle that the surfaces send this way

  void include(Pair<float> at) {
    left = std::min(left, at.x), right = std::max(right, at.x);
    top = std::min(top, at.y), bottom = std::max(bottom, at.y);
  }
  bool empty() const { return right < left; }
};

/// Where a direction from the camera meets the picture, in pixels. Returns false for a direction behind the camera.
inline bool project(const CameraColumns& c, Vec3f direction, Pair<float>& at) {
  const Vec3f normal = cross(c.du, c.dv);
  const float scale = dot(c.corner, normal) / dot(direction, normal);
  if (!(scale > 0)) return false;
  const Vec3f place = scale * direction - c.corner;
  at = {dot(place, c.du) / dot(c.du, c.du), dot(place, c.dv) / dot(c.dv, c.dv)};
  return true;
}

}  // namespace tyndall

#pragma once
#include "core/compile/render_scene.h"

#include <algorithm>
#include <vector>

/// Whether two compiled scenes are the same to the last bit.
namespace tyndall::test {

inline bool same(const Affine& a, const Affine& b) {
  return std::equal(a.row, a.row + 3, b.row) && std::equal(a.offset, a.offset + 3, b.offset);
}
inline bool same(const Outline& a, const Outline& b) { return a.kind == b.kind && a.size == b.size; }
inline bool same(const Flats& a, const Flats& b) {
  return a.element == b.element &&
         std::equal(a.outline.begin(), a.outline.end(), b.outline.begin(), b.outline.end(),
                    [](const Outline& x, const Outline& y) { return same(x, y); }) &&
         std::equal(a.map.begin(), a.map.end(), b.map.begin(), b.map.end(),
                    [](const Affine& x, const Affine& y) { return same(x, y); });
}
inline bool same(const Spheres& a, const Spheres& b) {
  return a.center == b.center && a.radius == b.radius && a.move == b.move && a.element == b.element;
}
inline bool same(const Elements& a, const Elements& b) {
  return a.center_or_normal == b.center_or_normal && a.inverse_radius == b.inverse_radius && a.move == b.move &&
         a.material == b.material && a.uv == b.uv && a.disk == b.disk && a.object == b.object;
}
inline bool same(const CameraColumns& a, const CameraColumns& b) {
  return a.center == b.center && a.corner == b.corner && a.du == b.du && a.dv == b.dv && a.lens_u == b.lens_u &&
         a.lens_v == b.lens_v && a.axis == b.axis && a.shutter_open == b.shutter_open &&
         a.shutter_length == b.shutter_length && a.surface.element == b.surface.element;
}
inline bool same(const Materials& a, const Materials& b) {
  return a.kind == b.kind && a.colour == b.colour && a.texture == b.texture &&
         std::equal(std::begin(a.parameter), std::end(a.parameter), b.parameter);
}
inline bool same(const Column<MediumColumns>& a, const Column<MediumColumns>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const MediumColumns& x, const MediumColumns& y) {
    return x.box == y.box && x.center == y.center && x.radius == y.radius && same(x.map, y.map) && x.first == y.first &&
           x.count == y.count && x.density == y.density && x.g == y.g && x.albedo == y.albedo && x.texture == y.texture;
  });
}
inline bool same_geometry(const RenderScene& a, const RenderScene& b) {
  return same(a.spheres, b.spheres) && same(a.moving_spheres, b.moving_spheres) && same(a.quads, b.quads) &&
         same(a.boxes, b.boxes) && same(a.outlined, b.outlined) && same(a.elements, b.elements) &&
         same(a.media, b.media);
}
inline bool same_tree(const RenderScene& a, const RenderScene& b) {
  return a.bvh.input == b.bvh.input && a.bvh.order == b.bvh.order && a.bvh.nodes.size() == b.bvh.nodes.size();
}
inline bool same(const RenderScene& a, const RenderScene& b) {
  return same_geometry(a, b) && same_tree(a, b) && same(a.camera, b.camera) && same(a.materials, b.materials) &&
         a.origin == b.origin && a.features == b.features && a.film_quantum == b.film_quantum &&
         a.max_depth == b.max_depth && a.seed == b.seed && a.schlick == b.schlick && a.width == b.width &&
         a.height == b.height;
}

}  // namespace tyndall::test

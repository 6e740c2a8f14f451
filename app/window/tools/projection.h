#pragma once
#include "app/window/tools/selection.h"
#include "core/scene/scene.h"

#include <optional>
#include <vector>

/// From points in space to points of the picture and back, and what is seen at them.
namespace tyndall {

/// A point of the image: x to the right and y down, both in [0, 1] inside it.
struct ImagePoint {
  double x = 0, y = 0;
};
/// Two points of a line.
struct ImageLine {
  ImagePoint a, b;
};

/// A line of sight. direction: unit.
struct ViewRay {
  Vec3d origin, direction;
};

/// How a scene's camera sees points. The lens and the shutter are left out.
class Projection {
 public:
  explicit Projection(const Scene& scene);

  const Camera camera;
  /// Where a point is seen; nothing for points that are behind the eye or too close before it.
  std::optional<ImagePoint> point(Vec3d p) const;
  /// The part of a line that is before the eye; nothing where there is none.
  std::optional<ImageLine> line(Vec3d from, Vec3d to) const;
  /// The line of sight through a point of the image.
  ViewRay view_ray(ImagePoint at) const;
  /// Height of the picture in scene units, at a depth along the camera's axis.
  double height_at(double depth) const { return height_ * depth; }
  /// Depth of a point along the camera's axis.
  double depth_of(Vec3d p) const;

 private:
  ImagePoint seen(Vec3d in_frame) const;

  double height_, width_, near_;
};

/// The outline of an object as the camera sees it, hidden or not: a sphere's silhouette, the edges of flat
/// shapes, the silhouette of boxes. Of a group: of what is in it, up to a limit. What is behind the eye is left out.
std::vector<ImageLine> outline(const Scene& scene, const ObjectPath& path);

/// An object and how far along the line of sight it begins, scene units.
struct ObjectUnder {
  ObjectPath path;
  double distance = 0;
  bool medium = false;
};

/// The objects that a line of sight meets, nearest first; groups count as what is in them. Fog and boxes of media that
/// hold the eye are not met: they cannot be seen from there. Moving spheres are where they are at time 0.
std::vector<ObjectUnder> objects_under(const Scene& scene, ImagePoint at);

}  // namespace tyndall

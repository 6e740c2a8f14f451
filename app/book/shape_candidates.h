#pragma once
#include "app/book/reading.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Shapes of a scene that one of the reader's may be, by its members.
namespace tyndall {

/// Where a shot's line meets a surface.
struct Crossing {
  double t = 0;
  Vector normal;
};
/// An object of the scene: where it lies for the object that encloses it.
struct Piece {
  Vector centre;
  double size = 1;
  bool is_solid = false, is_rectangle = false;
  std::array<Vector, 2> corners{};  ///< of a rectangle: opposite ones
  std::string material{}, moves{};
};
/// A shape of the scene, which one of the reader's may be.
struct Candidate {
  std::string text;  ///< JSON, without its end
  Piece piece;       ///< if it is solid, its normals point out, or to the ray
  /// A shot near it, at its time.
  std::function<Shot(RandomNumbers&, double time)> aim;
  /// Where the line of a shot meets it, nearest first; nothing: it is too near an edge to be sure.
  std::function<std::optional<std::vector<Crossing>>(const Shot&)> crossings;
};

/// The middle of a sphere that moves evenly.
struct Motion {
  Vector begin, end;  ///< at the times 0 and 1
  Vector at(double time) const { return begin + time * (end - begin); }
};
/// The middles that a sphere with these members may have, slow ones before those that stand still.
std::vector<Motion> motions_of(const Described& o);
Candidate sphere_of(const Motion& centre, double radius);

/// A part of the plane corner + a u + b v.
struct Plane {
  Vector corner, u, v;
  Vector normal() const { return cross(u, v); }
  Vector at(double a, double b) const { return corner + a * u + b * v; }
  /// From its front; meets it at t = 1.
  Shot shot(double a, double b) const {
    const Vector away = (length(u) + length(v)) * normalized(normal());
    return {at(a, b) + away, -1 * away};
  }
};
/// The planes that a flat shape with these members may lie in.
std::vector<Plane> planes_of(const Described& o);
/// What a quad, a triangle, or a disk or ring with these radii is of a plane.
struct Flat {
  Plane plane;
  std::string type;
  double inner = 0, outer = 1;
  bool is_disk() const { return type == "disk"; }
  std::string text() const;  ///< JSON, without its end
  Vector middle() const { return plane.at(is_disk() ? 0.5 * (inner + outer) : 0.3, is_disk() ? 0 : 0.3); }
  /// How far a place lies within the edges, as a part of the sides.
  double depth(double a, double b) const;
};
Candidate flat_of(const Flat& flat, double precision);

/// Leaves out the first or the last hit now and then; whether none is at an end of the interval.
bool set_interval(Shot& shot, const std::vector<Crossing>& met, int k);

}  // namespace tyndall

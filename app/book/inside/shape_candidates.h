#pragma once
#include "app/book/inside/reading.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// Where a shot's line meets a surface.
struct Crossing {
  double t = 0;
  Vec3d normal;
};

/// A shape of a scene, which one of the reader's may be.
struct Candidate {
  std::string type;   ///< sphere, quad, triangle or disk
  Vec3d at, u, v;     ///< of a sphere: its middle at the time 0, and the way to that at the time 1; else at + a u + b v
  double radius = 1;  ///< of a sphere or disk
  double inner = 0;   ///< that of a disk's hole
  bool is_sphere() const { return type == "sphere"; }
  bool is_disk() const { return type == "disk"; }
  bool is_rectangle() const { return type == "quad" && is_near(dot(u, v), 0, 1e-9); }

  Vec3d place(double a, double b) const { return at + a * u + b * v; }
  Vec3d normal() const { return cross(u, v); }
  Vec3d middle() const;
  double size() const;
  std::string text() const;  ///< JSON, without its end
  /// A shot from a flat one's front; meets the place at t = 1.
  book::shot shot_at(double a, double b) const;
  /// A shot near it.
  book::shot aim(RandomNumbers& random, double time) const;
  /// Where the line of a shot meets it, nearest first; nothing: it is too near an edge to be sure. Normals point out of
  /// spheres.
  std::optional<std::vector<Crossing>> crossings(const book::shot& shot, double precision) const;
};

/// The spheres that one with these members may be, slow ones before those that stand still.
std::vector<Candidate> spheres_of(const Described& o);
/// The planes that a flat shape with these members may lie in.
std::vector<Candidate> planes_of(const Described& o);

}  // namespace tyndall

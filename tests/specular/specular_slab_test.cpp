#include "core/specular/specular_trail.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

/// Paths through panes by their event sequences: which faces they meet, and that a closed one of these closes the way.
/// Paths through panes: a ray that starts along one is refracted and reflected to its far end, and neighbouring rays
/// fill the area that is said. Event sequences are drawn as often as is said.

namespace tyndall::test::specular_slab_test {

namespace {

constexpr int lower(int edge) { return 1 << 2 * edge; }
constexpr int upper(int edge) { return 2 << 2 * edge; }

/// The faces without which a way is open: those whose closing closes it. The near point is above the pane if `above`.
int faces_met(bool above, int across, double crossings, double first, double second) {
  SpecularFlat<double> slab{};
  SlabFrame<double> frame{};
  frame.near.height = above ? 3 : -3;
  const SlabSequence<double> sequence{across, crossings, {first, second}};
  int met = 0;
  for (int face = 0; face < 6; ++face) {
    slab.closed = 1 << face;
    if (!is_open(slab, frame, sequence)) met |= 1 << face;
  }
  slab.closed = 0;
  CHECK(is_open(slab, frame, sequence));
  slab.closed = met;
  CHECK(is_open(slab, frame, sequence) == (met == 0));
  slab.closed = 63 & ~met;
  CHECK(is_open(slab, frame, sequence));
  return met;
}

}  // namespace

TEST_CASE("specular paths: one off the outside of a slab meets the face on the point's side alone") {
  for (int edge = 0; edge < 3; ++edge) {
    CAPTURE(edge);
    CHECK(faces_met(true, edge, 0, 0, 0) == upper(edge));
    CHECK(faces_met(false, edge, 0, 0, 0) == lower(edge));
  }
}

TEST_CASE(
    "specular paths: one through a slab meets the two faces that it crosses, and the side faces that reflect it") {
  for (const bool above : {true, false})
    for (int edge = 0; edge < 3; ++edge) {
      CAPTURE(above);
      CAPTURE(edge);
      const int one = (edge + 1) % 3, two = (edge + 2) % 3, through = lower(edge) | upper(edge);
      CHECK(faces_met(above, edge, 1, 0, 0) == through);
      CHECK(faces_met(above, edge, 2, 0, 0) == through);
      CHECK(faces_met(above, edge, 1, 1, 0) == (through | upper(one)));
      CHECK(faces_met(above, edge, 1, -1, 0) == (through | lower(one)));
      CHECK(faces_met(above, edge, 1, 0, 1) == (through | upper(two)));
      CHECK(faces_met(above, edge, 3, -2, -1) == (through | lower(one) | upper(one) | lower(two)));
      CHECK(faces_met(above, edge, 1, 2, 2) == 63);
    }
}

namespace {

/// A floor and a light, and a box of glass between them, turned about the y axis.
struct SlabScene {
  Vec3d half;
  RenderScene compiled;
  SceneViewOf view;
  SpecularFlat<double> slab;

  static RenderScene make(Vec3d half, Vec3d light_at, double light_radius) {
    Scene scene = dark_room();
    scene.render.integrator = Integrator::mis;
    add(scene, Quad<>{{-9, -4, -9}, {18, 0, 0}, {0, 0, 18}}, lambertian(0.5));
    add(scene, sphere(light_at, light_radius), lamp(1));
    add(scene, Box<>{-half, half}, glass(1.5), {RotateY{25}, Translate{{0.3, 0.2, 0.1}}});
    return compile(scene);
  }
  explicit SlabScene(Vec3d half_size, Vec3d light_at = {1, 4, 3}, double light_radius = 0.01)
      : half(half_size), compiled(make(half, light_at, light_radius)), view(compiled) {
    REQUIRE(view.view().specular.has_slabs());
    slab = load_flat<double>(view.view().specular, 0);
  }
  Vec3d middle() const { return Vec3d{0.3, 0.2, 0.1} - compiled.origin; }
  double along_edge(int edge, Vec3d direction) const { return dot(slab.row[edge], direction); }
};

/// A ray through the box, in the frame of its edges.
struct Traced {
  double at[3], direction[3];
};

/// Follows a ray from outside through the box, face by face: `crossings` times from one end of edge `across` to the
/// other, reflected there but for the first and the last time, and at all other faces. met: how many of those it meets
/// at the ends of each edge.
std::optional<Traced> trace(const SlabScene& scene, Traced ray, int across, int crossings, int (&met)[3]) {
  const double half[3] = {scene.half.x, scene.half.y, scene.half.z}, index = 1.5;
  met[0] = met[1] = met[2] = 0;
  const auto go = [&](double t) {
    for (int k = 0; k < 3; ++k) ray.at[k] += t * ray.direction[k];
  };
  go((-std::copysign(half[across], ray.direction[across]) - ray.at[across]) / ray.direction[across]);
  for (int k = 0; k < 3; ++k)
    if (std::abs(ray.at[k]) > half[k] * (1 + 1e-9)) return std::nullopt;
  const auto bend = [&](double eta) {  // direction times eta along the face
    double rest = 1;
    for (int k = 0; k < 3; ++k)
      if (k != across) ray.direction[k] *= eta, rest -= ray.direction[k] * ray.direction[k];
    ray.direction[across] = std::copysign(std::sqrt(rest), ray.direction[across]);
  };
  if (crossings == 0) {
    ray.direction[across] = -ray.direction[across];
    return ray;
  }
  bend(1 / index);
  for (int left = crossings;;) {
    double minimum = 1e300;
    int face = 0;
    for (int k = 0; k < 3; ++k) {
      const double t = (std::copysign(half[k], ray.direction[k]) - ray.at[k]) / ray.direction[k];
      if (t < minimum) minimum = t, face = k;
    }
    go(minimum);
    if (face == across && --left == 0) break;
    ray.direction[face] = -ray.direction[face];
    if (face != across) ++met[face];
  }
  bend(index);
  return ray;
}

Traced framed_ray(const SlabScene& scene, Vec3d from, Vec3d direction) {
  Traced ray{};
  for (int k = 0; k < 3; ++k)
    ray.at[k] = scene.along_edge(k, from - scene.middle()), ray.direction[k] = scene.along_edge(k, direction);
  return ray;
}

Vec3d in_world(const SlabScene& scene, const double (&edges)[3]) {
  return edges[0] * scene.slab.row[0] + edges[1] * scene.slab.row[1] + edges[2] * scene.slab.row[2];
}

/// An event sequence whose way may exist between two points outside of the slab.
SlabSequence<double> random_sequence(Engine& engine, int across, bool same) {
  std::uniform_int_distribution<int> image(-2, 2), revolutions(0, 1);
  SlabSequence<double> sequence{across, 2.0 * revolutions(engine) + (same ? 0 : 1), {0, 0}};
  if (sequence.crossings > 0) sequence.image[0] = image(engine), sequence.image[1] = image(engine);
  return sequence;
}

}  // namespace

TEST_CASE("specular paths: a ray that starts along the one through a slab arrives at its far end") {
  Engine engine(5);
  int found = 0, reflected = 0;
  for (const Vec3d half : {Vec3d{2, 1.5, 0.1}, Vec3d{0.8, 0.8, 0.8}}) {
    const SlabScene scene(half);
    for (int i = 0; i < 60000; ++i) {
      const int across = i % 3;
      const Vec3d near = scene.middle() + in_cube(engine, 3.5), far = scene.middle() + in_cube(engine, 3.5);
      const SlabFrame<double> frame = slab_frame(scene.slab, near, far, across);
      if (frame.near_gap < 0.02 || frame.far_gap < 0.02) continue;
      const SlabSequence<double> sequence = random_sequence(engine, across, frame.same);
      const SpecularPath<double> path = slab_path(scene.slab, frame, sequence);
      int met[3];
      const std::optional<Traced> end =
          trace(scene, framed_ray(scene, near, path.direction), across, static_cast<int>(sequence.crossings), met);
      const int first = (across + 1) % 3, second = (across + 2) % 3;
      const bool fits = end && met[first] == std::abs(sequence.image[0]) && met[second] == std::abs(sequence.image[1]);
      if (!path.found) continue;
      ++found, reflected += met[first] + met[second] > 0 ? 1 : 0;
      REQUIRE(fits);
      const Vec3d leaves = in_world(scene, end->direction), at = scene.middle() + in_world(scene, end->at);
      CHECK(length(leaves - path.arrive) < 1e-5);
      CHECK(length(at + path.far_distance * path.arrive - far) < 1e-4);
      const Vec3d entry = near + path.near_distance * path.direction;
      CHECK(std::abs(std::abs(scene.along_edge(across, entry - scene.middle())) - (across == 0   ? half.x
                                                                                   : across == 1 ? half.y
                                                                                                 : half.z)) < 1e-5);
      const int faces[3] = {met[0], met[1], met[2]};
      const int code = (faces[0] + (across == 0 ? static_cast<int>(sequence.crossings) + 1 : 0)) |
                       (faces[1] + (across == 1 ? static_cast<int>(sequence.crossings) + 1 : 0)) << 4 |
                       (faces[2] + (across == 2 ? static_cast<int>(sequence.crossings) + 1 : 0)) << 8 | across << 12;
      const SlabSequence<double> told = slab_sequence_of(scene.slab, SpecularHistory<double>{code}, path.arrive);
      CHECK(told.across == sequence.across);
      CHECK(told.crossings == sequence.crossings);
      CHECK(told.image[0] == sequence.image[0]);
      CHECK(told.image[1] == sequence.image[1]);
    }
  }
  CHECK(found > 3000);
  CHECK(reflected > 200);
}

TEST_CASE("specular paths: the area that a small solid angle fills through a slab") {
  const SlabScene scene({0.8, 0.8, 0.8});
  Engine engine(7);
  int found = 0;
  while (found < 200) {
    const Vec3d near = scene.middle() + in_cube(engine, 3), far = scene.middle() + in_cube(engine, 3);
    const SlabFrame<double> frame = slab_frame(scene.slab, near, far, 2);
    if (frame.near_gap < 0.02 || frame.far_gap < 0.02) continue;
    const SlabSequence<double> sequence = random_sequence(engine, 2, frame.same);
    const SpecularPath<double> path = slab_path(scene.slab, frame, sequence);
    if (!path.found) continue;
    const auto arrival = [&](Vec3d direction) -> std::optional<Vec3d> {  // on the plane across the way at its far end
      int met[3];
      const auto end =
          trace(scene, framed_ray(scene, near, normalize(direction)), 2, static_cast<int>(sequence.crossings), met);
      if (!end || met[0] != std::abs(sequence.image[0]) || met[1] != std::abs(sequence.image[1])) return std::nullopt;
      const Vec3d out = in_world(scene, end->direction), at = scene.middle() + in_world(scene, end->at);
      return at + (dot(far - at, path.arrive) / dot(out, path.arrive)) * out;
    };
    constexpr double step = 1e-5;
    const Basis<double> across = basis_around(path.direction);
    const auto a = arrival(path.direction + step * across.s), b = arrival(path.direction - step * across.s);
    const auto c = arrival(path.direction + step * across.t), d = arrival(path.direction - step * across.t);
    if (!a || !b || !c || !d) continue;
    const double area = length(cross((0.5 / step) * (*a - *b), (0.5 / step) * (*c - *d)));
    CHECK(path.spread == doctest::Approx(area).epsilon(1e-3).scale(0));
    ++found;
  }
}

TEST_CASE(
    "specular paths: a slab's event sequences have the stated probabilities, and all that paths may meet are drawn") {
  using Name = std::tuple<int, int, int, int>;
  const Vec3d light_at{1, 2.5, 2};
  const SlabScene scene({0.8, 0.8, 0.8}, light_at, 0.1);
  const BoundingSphere<double> lamp{light_at - scene.compiled.origin, 0.1};
  Engine engine(8);
  std::uniform_real_distribution<double> u(0, 1);
  int sequences = 0;
  for (int place = 0; place < 60; ++place) {
    const Vec3d point{-2 + 4 * u(engine), -2.5, -2 + 4 * u(engine)}, at = point - scene.compiled.origin;
    std::map<Name, double> sums;
    constexpr int draws = 20000;
    for (int i = 0; i < draws; ++i) {
      const Pair<double> random{u(engine), u(engine)};
      const DrawnSlabSequence<double> drawn = draw_slab_sequence(scene.slab, at, {0, 1, 0}, lamp, random, true);
      if (!drawn.drawn) continue;
      const SlabSequence<double>& w = drawn.sequence;
      CHECK(is_looked_for(scene.slab, slab_frame(scene.slab, at, lamp.center, w.across), lamp, w));
      sums[{w.across, static_cast<int>(w.crossings), static_cast<int>(w.image[0]), static_cast<int>(w.image[1])}] +=
          1 / (drawn.probability * draws);
    }
    for (const auto& [name, sum] : sums) {  // each event sequence as if it were always drawn
      const auto [across, crossings, first, second] = name;
      if (crossings > 2 || sum < 0.5) continue;
      const SlabFrame<double> s = slab_frame(scene.slab, at, lamp.center, across);
      const SlabSequence<double> sequence{
          across, static_cast<double>(crossings), {static_cast<double>(first), static_cast<double>(second)}};
      if (!slab_path(scene.slab, s, sequence).found) continue;
      CHECK(sum == doctest::Approx(1).epsilon(0.2).scale(0));
      ++sequences;
    }
  }
  CHECK(sequences > 12);
}

TEST_CASE("specular paths: through a slab a light sees the shading point within the sphere of seen_by_slab()") {
  const SlabScene scene({1.2, 1, 0.3});
  Engine engine(9);
  int found = 0;
  for (int i = 0; i < 60000; ++i) {
    const int across = i % 3;
    const Vec3d near = scene.middle() + in_cube(engine, 3), far = scene.middle() + in_cube(engine, 3);
    const SlabFrame<double> frame = slab_frame(scene.slab, near, far, across);
    if (frame.near_gap < 0.01 || frame.far_gap < 0.01) continue;
    const SlabSequence<double> sequence = random_sequence(engine, across, frame.same);
    const SpecularPath<double> path = slab_path(scene.slab, frame, sequence);
    if (!path.found) continue;
    const BoundingSphere<double> seen = seen_by_slab(scene.slab, frame, sequence);
    const Vec3d to = seen.center - far;
    const double beside = length(to + dot(to, -path.arrive) * path.arrive);
    CHECK(beside <= seen.radius + 1e-5);
    CHECK(dot(to, path.arrive) < seen.radius);
    ++found;
  }
  CHECK(found > 1000);
}

}  // namespace tyndall::test::specular_slab_test

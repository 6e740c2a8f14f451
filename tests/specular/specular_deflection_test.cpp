#include "tests/support/specular_spheres.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <vector>

/// Paths of light through spheres around one centre: all of them are found, each event sequence is tried as often as
/// the weights say, and the solid angle that is computed for a light is the one that traced rays find.
namespace tyndall::test::specular_deflection_test {

namespace {

struct Arguments {
  double index, inner_radius;
  EventSequence<double> sequence;
};
const Arguments all_words[] = {{1.5, 0, {1, 0, 0}},    {1.5, 0, {2, 0, 0}},   {1.5, 0, {3, 0, 0}},
                               {1.5, 0, {6, 0, 0}},    {0.7, 0, {2, 0, 0}},   {1.5, 0.85, {2, 2, 0}},
                               {1.5, 0.85, {2, 1, 1}}, {1.5, 0.4, {2, 0, 0}}, {1.5, 0.85, {3, 4, 0}}};

}  // namespace

TEST_CASE("specular paths: as many are found as a search finds, and each has the wanted deflection") {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> u(0, 1);
  int differ = 0, count = 0;
  for (int i = 0; i < 300; ++i) {
    const Arguments& w = all_words[static_cast<std::size_t>(i) % std::size(all_words)];
    const double near = 1.01 + 4 * u(engine), far = 1.1 + 4 * u(engine), angle = pi * u(engine);
    const Deflection<double> exact =
        deflection_between(sphere_of<double>(w.index, w.inner_radius), w.sequence, near, far);
    const Deflection<float> path =
        deflection_between(sphere_of<float>(w.index, w.inner_radius),
                           {static_cast<float>(w.sequence.outer), static_cast<float>(w.sequence.inner),
                            static_cast<float>(w.sequence.inner_reflected)},
                           static_cast<float>(near), static_cast<float>(far));
    const DeflectionRoots<float> roots = list_roots(path, static_cast<float>(angle), true);
    differ += static_cast<int>(roots.count) != roots_by_search(exact, angle, exact.last, 20000);
    for (int k = 0; k < static_cast<int>(roots.count); ++k, ++count) {
      const DeflectionRoot<float> root = take_root(path, roots, static_cast<float>(angle), static_cast<float>(k));
      const double off =
          (deflection_there(exact, static_cast<double>(root.s)) - static_cast<double>(root.sense) * angle) / (2 * pi);
      CHECK(std::abs(off - std::round(off)) < 1e-3);
    }
  }
  CHECK(differ <= 1);  // where two paths are about to merge, rounding decides whether there are two or none
  CHECK(count > 150);
}

TEST_CASE("specular paths: the solid angle that a light fills off a mirror sphere is what rays find") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> u(0, 1);
  const Vec3<double> point{0.4, -1.3, 0.2}, lamp{2.5, 1.0, 0.5};
  const double light_radius = 0.5;
  int hits = 0;
  constexpr int rays = 400000;
  const double distance = length(point), one_minus_cos = 1 - std::sqrt(1 - 1 / (distance * distance));
  for (int i = 0; i < rays; ++i) {
    const Vec3<double> d = around((-1 / distance) * point, 1 - one_minus_cos * u(engine), u(engine));
    const Interval<double> ball = sphere_interval(-point, 1.0, d);
    if (!ball.hit) continue;
    const Vec3<double> at = point_at(point, ball.near, d), reflected = reflect(d, at);
    const Interval<double> there = sphere_interval(lamp - at, light_radius, reflected);
    hits += there.hit && there.near > 0 ? 1 : 0;
  }
  const double traced = 2 * pi * one_minus_cos * hits / rays;
  SpecularSphere<double> b = sphere_of<double>(1, 0);
  b.mirror = true;
  const CommonSceneView s{};
  LightColumns<double> light{};
  light.kind = Lights::sphere, light.corner = lamp, light.length_u = light_radius;
  double sum = 0;
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) {
    const LightPoint<double> at =
        sample_light_point(s, 0, light, {b.center, b.radius}, point, 0.0, {u(engine), u(engine)});
    const PathPlane<double> plane = plane_of(b, point, at.point);
    const PathEnds<double> ends = ends_of(b, plane.near, plane.far);
    const Deflection<double> path = deflection_between(b, main_sequence(b, ends), plane.near, plane.far);
    const DeflectionRoots<double> roots = list_roots(path, plane.angle, true);
    REQUIRE(roots.count == 1);
    const DeflectionRoot<double> root = take_root(path, roots, plane.angle, 0.0);
    const double sine = path.maximum * (1 - root.s * root.s) / plane.far;
    const Vec3<double> arrive = point_at(std::sqrt(1 - sine * sine) * plane.far_out, root.sense * sine, plane.far_side);
    const double cosine = light_cosine(light, at.normal, arrive);
    if (cosine > 0) sum += 1 / (at.pdf * spread_of(path, ends, plane.sine, root.s, root.slope, cosine));
  }
  CHECK(sum / points == doctest::Approx(traced).epsilon(0.02).scale(0));
}

TEST_CASE("specular paths: each event sequence is tried as often as expected_queries() says") {
  std::mt19937_64 engine(11);
  struct Place {
    double inner_radius;
    float near, far;
  };
  for (const auto& [inner_radius, near, far] :
       {Place{0, 2, 3}, Place{0.85, 2, 3}, Place{0.4, 2, 3}, Place{0, 0.5f, 0.4f}, Place{0.85, 0.5f, 0.4f},
        Place{0.6, 0.8f, 0.4f}}) {
    CAPTURE(inner_radius);
    CAPTURE(near);
    const SpecularSphere<float> b = sphere_of<float>(1.5, inner_radius);
    const PathEnds<float> ends = ends_of(b, near, far);
    REQUIRE((ends.both_out || (ends.valid && ends.both_in)));
    constexpr int draws = 400000;
    std::map<std::array<int, 4>, int> drawn;  // events outer, inner, reflections there, and the near end's sign
    for (int i = 0; i < draws; ++i) {
      const std::uint64_t bits = engine();
      const DrawnSequence<float> d =
          draw_sequence(b, ends, {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32u)});
      if (!d.drawn) continue;
      const EventSequence<float>& w = d.sequence;
      ++drawn[{static_cast<int>(w.outer), static_cast<int>(w.inner), static_cast<int>(w.inner_reflected),
               ends.near_in_glass ? static_cast<int>(w.near_sign) : 1}];
    }
    int checked = 0, longest = 0;
    for (const auto& [events, times] : drawn) {
      const auto [outer, inner, inner_reflected, near_sign] = events;
      longest = std::max(longest, outer + inner);
      const EventSequence<float> sequence{static_cast<float>(outer), static_cast<float>(inner),
                                          static_cast<float>(inner_reflected), static_cast<float>(near_sign)};
      // Of one order only. From inside: either all events inside the hollow or solid glass, or one visit to the glass.
      const bool one_order = ends.both_out
                                 ? inner_reflected == 0 && outer <= 3
                                 : inner == 0 || (outer == 0 && inner == inner_reflected) || outer + inner <= 2 ||
                                       (outer == 1 && inner == 2 && inner_reflected == 0);
      if (!one_order) continue;
      ++checked;
      const double by_plan = same_sequence(sequence, main_sequence(b, ends)) ? static_cast<double>(main_queries(b)) : 0;
      const double expected = (static_cast<double>(expected_queries(b, ends, sequence)) - by_plan) * draws;
      CAPTURE(sequence.outer);
      CAPTURE(sequence.inner);
      CAPTURE(sequence.near_sign);
      if (ends.both_in) CHECK(expected > 0);
      CHECK(std::abs(times - expected) < 6 * std::sqrt(expected) + 1);
    }
    CHECK(checked >= 2);
    CHECK(longest >= (ends.both_in ? max_inside_events : inner_radius > 0 ? 16 : 8));
    CHECK(expected_queries(b, ends, main_sequence(b, ends)) >= main_queries(b));
    // The main event sequence of solid glass is not drawn as well.
    if (ends.both_out && inner_radius == 0) CHECK(drawn.count({2, 0, 0, 1}) == 0);
  }
}

}  // namespace tyndall::test::specular_deflection_test

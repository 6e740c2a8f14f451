#include "core/specular/chain_path.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <vector>

/// Ways of light through spheres around one centre: all of them are found, and the solid angle that chains compute for
/// a lamp is the one that traced rays find.
using namespace tyndall;

namespace {

template <class F>
ChainBall<F> ball_of(double index, double inner_radius) {
  ChainBall<F> b{};
  b.radius = F(1), b.index = F(index), b.inner_radius = F(inner_radius), b.inner_index = F(1);
  b.mirror = false, b.hollow = inner_radius > 0, b.crowded = false;
  return b;
}

template <class F>
ChainTurn<F> turn_between(const ChainBall<F>& b, const ChainWord<F>& word, F near, F far) {
  ChainView view{};
  view.shells = b.hollow;
  return turn_of(view, b, ends_of(b, near, far), word, EndSigns<F>{F(1), F(1)});
}

/// The turn itself, term by term.
double turn_there(const Turn<double>& turn, double s) {
  double sum = 0;
  for (int i = 0; i < turn.terms; ++i)
    sum += turn.times[i] * std::acos(std::min(1.0, turn.most * (1 - s * s) * turn.inverse[i]));
  return sum;
}

/// How many ways there are, found by a slow search: counts how often the turn passes `angle` or its negative, plus any
/// number of full turns, from one of many places of s to the next.
int roots_by_search(const Turn<double>& turn, double angle) {
  constexpr int places = 20000;
  const double first = static_cast<double>(least_parameter);
  int count = 0;
  for (const double sign : {1.0, -1.0}) {
    double last = 0;
    for (int i = 0; i <= places; ++i) {
      const double s = first + (turn.last - first) * i / places;
      const double whole = std::floor((turn_there(turn, s) - sign * angle) / (2 * pi));
      if (i > 0) count += static_cast<int>(std::abs(whole - last));
      last = whole;
    }
  }
  return count;
}

struct Words {
  double index, inner_radius;
  ChainWord<double> word;
};
const Words all_words[] = {{1.5, 0, {1, 0, 0}},    {1.5, 0, {2, 0, 0}},   {1.5, 0, {3, 0, 0}},
                           {1.5, 0, {6, 0, 0}},    {0.7, 0, {2, 0, 0}},   {1.5, 0.85, {2, 2, 0}},
                           {1.5, 0.85, {2, 1, 1}}, {1.5, 0.4, {2, 0, 0}}, {1.5, 0.85, {3, 4, 0}}};

}  // namespace

TEST_CASE("chains: as many ways are found as a search finds, and each turns as wanted") {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> u(0, 1);
  int differ = 0, count = 0;
  for (int i = 0; i < 300; ++i) {
    const Words& w = all_words[static_cast<std::size_t>(i) % std::size(all_words)];
    const double near = 1.01 + 4 * u(engine), far = 1.1 + 4 * u(engine), angle = pi * u(engine);
    const ChainTurn<double> exact = turn_between(ball_of<double>(w.index, w.inner_radius), w.word, near, far);
    const ChainTurn<float> chain = turn_between(ball_of<float>(w.index, w.inner_radius),
                                                {static_cast<float>(w.word.outer), static_cast<float>(w.word.inner),
                                                 static_cast<float>(w.word.inner_reflected)},
                                                static_cast<float>(near), static_cast<float>(far));
    const TurnRoots<float> roots = list_roots(chain.turn, static_cast<float>(angle), true);
    differ += static_cast<int>(roots.count) != roots_by_search(exact.turn, angle);
    for (int k = 0; k < static_cast<int>(roots.count); ++k, ++count) {
      const TurnRoot<float> root = take_root(chain.turn, roots, static_cast<float>(angle), static_cast<float>(k));
      const double off =
          (turn_there(exact.turn, static_cast<double>(root.s)) - static_cast<double>(root.sense) * angle) / (2 * pi);
      CHECK(std::abs(off - std::round(off)) < 1e-3);
    }
  }
  CHECK(differ <= 1);  // where two ways are about to merge, rounding decides whether there are two or none
  CHECK(count > 150);
}

TEST_CASE("chains: the solid angle that a lamp fills off a mirror ball is what rays find") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> u(0, 1);
  const Vec3<double> point{0.4, -1.3, 0.2}, lamp{2.5, 1.0, 0.5};
  const double lamp_radius = 0.5;
  int hits = 0;
  constexpr int rays = 400000;
  const double distance = length(point), one_minus_cos = 1 - std::sqrt(1 - 1 / (distance * distance));
  for (int i = 0; i < rays; ++i) {
    const Vec3<double> d = around((-1 / distance) * point, 1 - one_minus_cos * u(engine), u(engine));
    const Interval<double> ball = sphere_interval(-point, 1.0, d);
    if (!ball.hit) continue;
    const Vec3<double> at = along(point, ball.near, d), reflected = reflect(d, at);
    const Interval<double> there = sphere_interval(lamp - at, lamp_radius, reflected);
    hits += there.hit && there.near > 0 ? 1 : 0;
  }
  const double traced = 2 * pi * one_minus_cos * hits / rays;
  ChainBall<double> b = ball_of<double>(1, 0);
  b.mirror = true;
  LightColumns<double> light{};
  light.kind = Lights::sphere, light.corner = lamp, light.length_u = lamp_radius;
  double sum = 0;
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) {
    const LampPoint<double> at = sample_lamp(light, b, point, 0.0, Pair<double>{u(engine), u(engine)});
    const ChainPlane<double> plane = plane_of(b, point, at.point);
    const ChainEnds<double> ends = ends_of(b, plane.near, plane.far);
    const ChainTurn<double> chain = turn_between(b, main_word(b, ends), plane.near, plane.far);
    const TurnRoots<double> roots = list_roots(chain.turn, plane.angle, true);
    REQUIRE(roots.count == 1);
    const TurnRoot<double> root = take_root(chain.turn, roots, plane.angle, 0.0);
    const double sine = chain.turn.most * (1 - root.s * root.s) / plane.far;
    const Vec3<double> arrive = along(std::sqrt(1 - sine * sine) * plane.far_out, root.sense * sine, plane.far_side);
    const double cosine = lamp_cosine(light, at.normal, arrive);
    if (cosine > 0) sum += 1 / (at.density * spread_of(chain, ends, plane.sine, root.s, root.slope, cosine));
  }
  CHECK(sum / points == doctest::Approx(traced).epsilon(0.02).scale(0));
}

TEST_CASE("chains: light is asked for by each word as often as is said") {
  std::mt19937_64 engine(11);
  for (const double inner_radius : {0.0, 0.85, 0.4}) {
    CAPTURE(inner_radius);
    const ChainBall<float> b = ball_of<float>(1.5, inner_radius);
    const ChainEnds<float> ends = ends_of(b, 2.0f, 3.0f);
    constexpr int draws = 400000;
    std::map<std::array<int, 3>, int> drawn;  // by events at the outer sphere, at the inner one, and reflections there
    for (int i = 0; i < draws; ++i) {
      const std::uint64_t bits = engine();
      const DrawnWord<float> d =
          draw_word(b, ends, {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32u)});
      if (!d.drawn) continue;
      const ChainWord<float>& w = d.word;
      ++drawn[{static_cast<int>(w.outer), static_cast<int>(w.inner), static_cast<int>(w.inner_reflected)}];
    }
    int longest = 0;
    for (const auto& [events, times] : drawn) {
      const auto [outer, inner, inner_reflected] = events;
      longest = std::max(longest, outer + inner);
      // Of one order only: other words have several.
      if (inner_reflected > 0 || outer > 3) continue;
      const ChainWord<float> word{static_cast<float>(outer), static_cast<float>(inner), 0};
      const double by_plan = same_word(word, main_word(b, ends)) ? static_cast<double>(main_asked(b)) : 0;
      const double expected = (static_cast<double>(times_asked(b, ends, word)) - by_plan) * draws;
      CAPTURE(outer);
      CAPTURE(inner);
      CHECK(std::abs(times - expected) < 6 * std::sqrt(expected) + 1);
    }
    CHECK(longest >= (inner_radius > 0 ? 16 : 8));
    CHECK(times_asked(b, ends, main_word(b, ends)) >= main_asked(b));
    if (inner_radius == 0) CHECK(drawn.count({2, 0, 0}) == 0);  // the main word is not drawn as well
  }
}

#include "core/specular/specular_path.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

/// Paths of light through spheres around one centre: all of them are found, traced as rays they arrive, and each event
/// sequence is tried as often as the weights say.
namespace tyndall::test::specular_spheres_test {

namespace {

/// A unit sphere of glass, hollow if `inner_radius` is not 0.
template <class F>
SpecularSphere<F> sphere_of(double index, double inner_radius) {
  SpecularSphere<F> b{};
  b.radius = F(1), b.index = F(index), b.inner_radius = F(inner_radius), b.inner_index = F(1);
  b.mirror = false, b.hollow = inner_radius > 0, b.overlapped = false;
  return b;
}

template <class F>
Deflection<F> deflection_between(const SpecularSphere<F>& b, const EventSequence<F>& sequence, F near, F far,
                                 EndSigns<F> sign = {F(1), F(1)}) {
  SpecularPairs view{};
  view.shells = b.hollow;
  return deflection_of(view, b, ends_of(b, near, far), sequence, sign);
}

/// The deflection itself, term by term.
double deflection_there(const Deflection<double>& deflection, double s) {
  double sum = 0;
  for (int i = 0; i < deflection.terms; ++i)
    sum += deflection.times[i] * std::acos(std::min(1.0, deflection.maximum * (1 - s * s) * deflection.inverse[i]));
  return sum;
}

/// The number of paths, found by a slow search: counts how often the deflection passes `angle` or its negative, plus
/// any number of revolutions, from one of many places of s to the next.
int roots_by_search(const Deflection<double>& deflection, double angle, double end, int places) {
  const double first = static_cast<double>(min_parameter);
  int count = 0;
  for (const double sign : {1.0, -1.0}) {
    double last = 0;
    for (int i = 0; i <= places; ++i) {
      const double s = first + (end - first) * i / places;
      const double whole = std::floor((deflection_there(deflection, s) - sign * angle) / (2 * pi));
      if (i > 0) count += static_cast<int>(std::abs(whole - last));
      last = whole;
    }
  }
  return count;
}

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

namespace {

/// Events in order, from the near end: i or o, inner or outer sphere, and R or T, reflected or transmitted.
struct Word {
  double index, inner_radius;
  bool in_glass;  ///< the near end is in a shell's glass
  std::string events;

  EventSequence<double> sequence() const {
    EventSequence<double> w{0, 0, 0, events[0] == 'i' ? 1.0 : -1.0};
    for (std::size_t k = 0; k < events.size(); k += 2) {
      const bool inner = events[k] == 'i';
      w.outer += inner ? 0 : 1, w.inner += inner ? 1 : 0;
      w.inner_reflected += inner && events[k + 1] == 'R' ? 1 : 0;
    }
    return w;
  }
};
const Word words[] = {{1.5, 0.85, false, "iR"},
                      {1.5, 0.85, false, "iRiR"},
                      {1.5, 0.85, false, "iRiRiRiR"},
                      {1.5, 0.85, false, "iToRiT"},
                      {1.5, 0.85, false, "iToRiRoRiT"},
                      {1.5, 0.4, false, "iToRiTiR"},
                      {1.5, 0.85, true, "iT"},
                      {1.5, 0.85, true, "iTiR"},
                      {1.5, 0.6, true, "oRiT"},
                      {1.5, 0.6, true, "iRoRiT"},
                      {1.5, 0, false, "oR"},
                      {1.5, 0, false, "oRoRoR"},
                      {0.7, 0, false, "oR"},
                      {1.2, 0.95, true, "iTiToRiT"}};

struct Point2 {
  double x, y;
};
double dot2(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

/// Where a ray in the plane of the path is at distance `far` from the centre after the word's events. inward: before it
/// has come closest to the centre. Nothing if a surface is missed.
std::optional<Point2> trace(const Word& word, Point2 at, Point2 d, double far, bool inward) {
  double n = word.in_glass || word.inner_radius == 0 ? word.index : 1;
  const auto advance = [&](double radius, bool first) {
    const double b = dot2(at, d), root = b * b - dot2(at, at) + radius * radius;
    if (root < 0) return false;
    const double near = -b - std::sqrt(root), t = first && near > 1e-9 ? near : -b + std::sqrt(root);
    at = {at.x + t * d.x, at.y + t * d.y};
    return t > 0;
  };
  for (std::size_t k = 0; k < word.events.size(); k += 2) {
    const double radius = word.events[k] == 'i' ? word.inner_radius : 1;
    if (!advance(radius, true)) return {};
    const Point2 normal{at.x / radius, at.y / radius};
    const double along = dot2(d, normal);
    if (word.events[k + 1] == 'R') {
      d = {d.x - 2 * along * normal.x, d.y - 2 * along * normal.y};
      continue;
    }
    const double to = n == 1 ? word.index : 1, eta = n / to, cosine = std::abs(along), side = along > 0 ? -1 : 1;
    const double root = 1 - eta * eta * (1 - cosine * cosine);
    if (root < 0) return {};
    const double k2 = side * (eta * cosine - std::sqrt(root));
    d = {eta * d.x + k2 * normal.x, eta * d.y + k2 * normal.y}, n = to;
  }
  if (!advance(far, inward)) return {};
  return at;
}

}  // namespace

TEST_CASE("specular paths with both ends inside: all are found, and traced as rays they arrive") {
  const int places = thorough() ? 60 : 15;
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (const Word& word : words) {
    CAPTURE(word.events);
    CAPTURE(word.inner_radius);
    const SpecularSphere<double> b = sphere_of<double>(word.index, word.inner_radius);
    const double wall = word.inner_radius > 0 ? word.inner_radius : 1;
    const EventSequence<double> sequence = word.sequence();
    int count = 0, differ = 0, lost = 0;
    for (int i = 0; i < places; ++i) {
      const double near =
          word.in_glass ? wall + (1 - wall) * (0.01 + 0.98 * u(engine)) : wall * (0.02 + 0.97 * u(engine));
      const double far = wall * (0.02 + 0.97 * u(engine)), angle = 0.05 + (pi - 0.1) * u(engine);
      for (int signs = 0; signs < 4; ++signs) {
        const EndSigns<double> sign{signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0};
        if (word.in_glass && sign.near != sequence.near_sign) continue;
        const PathEnds<double> ends = ends_of(b, near, far);
        const Deflection<double> path = deflection_between(b, sequence, near, far, sign);
        REQUIRE(path.possible);
        const DeflectionRoots<double> roots = list_roots(path, angle, true);
        differ += static_cast<int>(roots.count) != roots_by_search(path, angle, 1, 5000);
        for (int k = 0; k < static_cast<int>(roots.count); ++k, ++count) {
          const DeflectionRoot<double> root = take_root(path, roots, angle, static_cast<double>(k));
          const double sine = path.maximum * (1 - root.s * root.s) / ends.near_reach;
          const Point2 d{-sign.near * std::sqrt(1 - sine * sine), root.sense * sine};
          const auto end = trace(word, {near, 0}, d, far, sign.far < 0);
          if (!end || std::hypot(end->x - far * std::cos(angle), end->y - far * std::sin(angle)) > 1e-6) ++lost;
        }
      }
    }
    CHECK(differ <= 1);
    CHECK(lost == 0);
    CHECK(count > places / 2);
  }
}

}  // namespace tyndall::test::specular_spheres_test

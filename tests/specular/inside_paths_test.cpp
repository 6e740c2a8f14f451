#include "tests/support/specular_spheres.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

/// Specular paths with both ends inside a sphere: all of them are found, and traced as rays they arrive.
namespace tyndall::test::inside_paths_test {

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

}  // namespace tyndall::test::inside_paths_test

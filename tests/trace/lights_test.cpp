#include "core/trace/lights.h"

#include "core/compile/columns.h"
#include "core/shapes/outline.h"
#include "core/trace/scene_view.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <optional>

namespace tyndall::test::lights_test {

namespace {

Sampler<float> sampler_of(std::uint32_t i) { return Sampler<float>::of(1, i, i >> 12, i * 7u); }

/// Solid angle of a parallelogram, or of what an outline leaves of it, by quadrature over its area, and the mean
/// direction over the solid angle.
struct Seen {
  double solid_angle = 0;
  Vec3d mean;
};
Seen quadrature(const Quad<>& q, Vec3d point, std::optional<Outline> outline = {}) {
  Seen seen;
  const int n = 400;
  const Vec3d normal = normalize(cross(q.u, q.v));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (outline && !within(*outline, (2 * i + 1.0) / n - 1, (2 * j + 1.0) / n - 1)) continue;
      const Vec3d offset = q.corner + ((i + 0.5) / n) * q.u + ((j + 0.5) / n) * q.v - point;
      const double d2 = dot(offset, offset);
      const Vec3d direction = (1 / std::sqrt(d2)) * offset;
      const double part = std::abs(dot(direction, normal)) * length(cross(q.u, q.v)) / (d2 * n * n);
      seen.solid_angle += part;
      seen.mean = seen.mean + part * direction;
    }
  seen.mean = (1 / seen.solid_angle) * seen.mean;
  return seen;
}

/// Checks 20000 samples of a scene's only light, as seen from a point: their density is the one that is found for the
/// direction by itself, and its inverse has the light's solid angle and mean direction. each: gets every sample.
template <class Each>
void check_samples(const RenderScene& scene, Vec3d from, const Seen& seen, double tolerance, const Each& each) {
  const SceneViewOf view(scene);
  const Vec3f point = rounded(from - scene.origin);
  Moments inverse, x, y, z;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const LightSample<float> s = sample_light<float>(view.view(), 0, point, 0.0f, sampler_of(i).next_2d(2));
    REQUIRE(s.pdf > 0);
    const double weight = 1 / static_cast<double>(s.pdf);
    inverse.add(weight);
    x.add(weight * static_cast<double>(s.direction.x));
    y.add(weight * static_cast<double>(s.direction.y));
    z.add(weight * static_cast<double>(s.direction.z));
    const float again = light_pdf<float>(view.view(), 0, point, 0.0f, s.direction, s.distance);
    REQUIRE(again == doctest::Approx(s.pdf).epsilon(1e-3).scale(0));
    each(s);
  }
  const std::pair<const Moments*, double> sums[] = {
      {&inverse, 1}, {&x, seen.mean.x}, {&y, seen.mean.y}, {&z, seen.mean.z}};
  for (const auto& [sum, expected] : sums)
    CHECK(std::abs(sum->estimate().mean - expected * seen.solid_angle) <
          4 * sum->estimate().error + tolerance * seen.solid_angle);
}

}  // namespace

TEST_CASE("lights: a rectangle is sampled uniformly in its solid angle, a far or slanting one by area") {
  Engine engine(5);
  for (int k = 0; k < 40; ++k) {
    const double size = std::pow(10.0, uniform(engine, -2, 2));
    const Vec3d u = size * direction(engine), helper = direction(engine);
    const Vec3d v = (k % 4 == 3 ? 1.0 : uniform(engine, 0.2, 3)) * (k % 4 == 3 ? size * helper : cross(u, helper));
    const Quad<> quad{size * in_cube(engine, 2), u, v};
    const Vec3d from = size * in_cube(engine, k % 2 ? 2 : 20);
    if (std::abs(dot(normalize(cross(u, v)), from - quad.corner)) < 0.2 * size) continue;
    CAPTURE(k);
    check_samples(lit({light_object(quad)}), from, quadrature(quad, from), 1e-3, [](const LightSample<float>&) {});
  }
}

TEST_CASE("lights: triangles are sampled evenly in solid angle, rings and small triangles by area") {
  Engine engine(6);
  int by_solid_angle = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3d u = direction(engine), v = uniform(engine, 0.3, 2) * direction(engine), at = in_cube(engine, 1);
    const bool is_disk = k % 3 == 0;
    const Triangle<> triangle{at, u, v};
    const Disk<> disk{at, u, v, k % 2 ? uniform(engine, 0.2, 0.9) : 0};
    const Vec3d from = in_cube(engine, k % 3 == 1 ? 1.5 : 5), normal = normalize(cross(u, v));
    if (std::abs(dot(normal, from - at)) < 0.2 || length(cross(u, v)) < 0.1) continue;
    const Seen seen = quadrature(is_disk ? frame_of(disk) : frame_of(triangle), from,
                                 is_disk ? outline_of(disk) : outline_of(triangle));
    bool even = true;
    CAPTURE(k);
    check_samples(lit({is_disk ? light_object(disk) : light_object(triangle)}), from, seen, 5e-3,
                  [&](const LightSample<float>& s) {
                    even =
                        even && std::abs(1 / static_cast<double>(s.pdf) - seen.solid_angle) < 5e-3 * seen.solid_angle;
                    const Vec3d hit = from + static_cast<double>(s.distance) * exact(s.direction) - at;
                    const Reciprocal r = reciprocal_edges(u, v);
                    const double a = dot(r.a, hit), b = dot(r.b, hit), slack = 1e-4;
                    if (!is_disk) REQUIRE(std::min({a, b, 1 - a - b}) > -slack);
                    if (is_disk) REQUIRE(std::hypot(a, b) < 1 + slack);
                    if (is_disk) REQUIRE(std::hypot(a, b) > disk.inner - slack);
                  });
    if (even && !is_disk) ++by_solid_angle;
  }
  CHECK(by_solid_angle > 15);
}

TEST_CASE("lights: a sphere is sampled over its cap, from touching to ten thousand radii away, and from inside") {
  for (const double distance : {0.0, 0.5, 0.999, 1.001, 1.01, 2.0, 100.0, 1e4}) {
    const RenderScene scene = lit({light_object(sphere({0, 0, 0}, 1))});
    const SceneViewOf view(scene);
    const Vec3f point = rounded(Vec3d{0, 0, -distance} - scene.origin);
    const double cosine = distance <= 1 ? -1 : std::sqrt(1 - 1 / (distance * distance));
    const double part = distance <= 1 ? 2 : 1 / (distance * distance) / (1 + cosine);  // 1 - cos
    Moments angle;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      const LightSample<float> s = sample_light<float>(view.view(), 0, point, 0.0f, sampler_of(i).next_2d(2));
      CHECK(static_cast<double>(s.pdf) == doctest::Approx(0.5 / pi / part).epsilon(1e-5).scale(0));
      CHECK(s.distance > 0);
      CHECK(static_cast<double>(length(point_at(point, s.distance, s.direction))) ==
            doctest::Approx(1).epsilon(1e-6 + 4e-7 * distance).scale(0));
      const double across2 = static_cast<double>(s.direction.x * s.direction.x + s.direction.y * s.direction.y);
      const double c = static_cast<double>(s.direction.z);
      angle.add((c > 0 ? across2 / (1 + c) : 1 - c) / part);  // uniform in [0, 1]
    }
    CAPTURE(distance);
    CHECK(std::abs(angle.estimate().mean - 0.5) < 4 * angle.estimate().error + 1e-5);
  }
}

TEST_CASE("lights: the choice has the probability it says, for one, a few and a thousand") {
  Engine engine(2);
  for (const int count : {1, 2, 16, 17, 1000}) {
    std::vector<Object> lamps;
    for (int i = 0; i < count; ++i) lamps.push_back(light_object(sphere(in_cube(engine, 5), uniform(engine, 0.1, 1))));
    const RenderScene scene = lit(lamps);
    const SceneViewOf view(scene);
    const Lights& lights = view.view().lights;
    const Vec3f point = rounded(in_cube(engine, 5));
    std::vector<int> taken(static_cast<std::size_t>(count));
    const int draws = 200000;
    double sum = 0;
    for (std::uint32_t i = 0; i < draws; ++i) {
      const LightChoice<float> choice = choose_light<float>(lights, point, sampler_of(i).next_1d(5));
      REQUIRE(choice.probability ==
              doctest::Approx(choice_probability<float>(lights, point, choice.light)).epsilon(1e-5).scale(0));
      ++taken[static_cast<std::size_t>(choice.light)];
    }
    double chi2 = 0;
    for (int k = 0; k < count; ++k) {
      const double p = static_cast<double>(choice_probability<float>(lights, point, k));
      sum += p;
      chi2 += std::pow(taken[static_cast<std::size_t>(k)] - draws * p, 2) / (draws * p);
    }
    CAPTURE(count);
    CHECK(sum == doctest::Approx(1).epsilon(1e-4).scale(0));
    CHECK(chi2 < count - 1 + 4.5 * std::sqrt(2.0 * count) + 1);
  }
}

TEST_CASE("lights: of a thousand alike, the one beside the point is asked most often") {
  std::vector<Object> lamps;
  for (int i = 0; i < 1000; ++i) {
    const double x = i % 10, y = i / 10 % 10, z = i / 100;
    lamps.push_back(light_object(sphere({2 * x, 2 * y, 2 * z}, 0.1)));
  }
  const RenderScene scene = lit(lamps);
  const SceneViewOf view(scene);
  const Lights& lights = view.view().lights;
  const int beside = 555;
  const Vec3f point = rounded(Vec3d{10, 10, 10.3} - scene.origin);
  const float probability = choice_probability<float>(lights, point, beside);
  // By power alone it would be 0.001, in exact proportion to what each contributes 0.4. The tree, which guesses from
  // groups, gives 0.045; with groups that count as spread over the whole of their boxes' diagonals, 0.024.
  CHECK(probability > 0.03f);
  CHECK(probability < 0.4f);
}

}  // namespace tyndall::test::lights_test

#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <functional>

/// Which lights are looked for by specular paths, and off or through what.
namespace tyndall::test::specular_pairs_test {

namespace {

using Change = std::function<void(Scene&)>;

/// A lamp over a floor, and what is added.
SpecularPairs specular_of(double light_radius, Vec3d light_center, const std::vector<Change>& changes) {
  Scene scene = lit_floor(light_radius, light_center, 1);
  for (const Change& change : changes) change(scene);
  return compile(scene).specular;
}

Change with(const auto& shape, const Material& material, const Transform& transform = {}) {
  return [=](Scene& s) { add(s, shape, material, transform); };
}
Change fog(const auto& boundary) {
  return [=](Scene& s) { add_medium(s, boundary, {0.1, 0}, 1); };
}
void by_light_sampling(Scene& s) { s.render.integrator = Integrator::nee; }
void by_chance(Scene& s) { s.render.caustics = Caustics::scatter; }
void by_books_rule(Scene& s) { s.render.fresnel = FresnelKind::schlick; }

const Material matt = lambertian(0.5), mirror = metal(0.8, 0), clear = glass(1.5);

}  // namespace

TEST_CASE("specular pairs: spheres with lights that are small as seen from them, and only those") {
  const auto pairs = [](
                         double light_radius, const Material& material, const Change& change = [](Scene&) {}) {
    return specular_of(light_radius, {0, 5.2, 0}, {with(sphere({0, 1.2, 0}, 1), material), change}).sphere.size();
  };
  CHECK(pairs(0.1, clear) == 1);
  CHECK(pairs(0.59, clear) == 1);
  CHECK(pairs(0.61, clear) == 0);
  CHECK(pairs(0.99, mirror) == 1);
  CHECK(pairs(1.01, mirror) == 0);
  CHECK(pairs(0.1, clear, by_light_sampling) == 0);
  CHECK(pairs(0.1, clear, by_chance) == 0);
  CHECK(pairs(0.1, clear, by_books_rule) == 0);
  CHECK(pairs(0.1, clear, with(sphere({0, 1.2, 0}, -0.8), clear)) == 1);
  CHECK(pairs(0.1, clear, with(sphere({0, 1.2, 0}, 0.8), glass(1.2))) == 0);  // filled with something else
  CHECK(pairs(0.1, clear, with(sphere({3, 1, 0}, 0.5), metal(0.8, 0.1))) == 1);
  CHECK(pairs(0.1, clear, with(sphere({0, 1.2, 0}, -1), glass(1.2))) == 0);  // two in one place
}

TEST_CASE("specular pairs: flat mirrors with lights that are small as seen from them, where their light is seen") {
  const Quad<> wall{{-6, 0, -4}, {12, 0, 0}, {0, 8, 0}};
  const auto pairs = [](
                         double light_radius, const Change& change, const Change& more = [](Scene&) {}) {
    return specular_of(light_radius, {0, 4, 0}, {change, more}).sphere.size();
  };
  CHECK(pairs(0.1, with(wall, mirror)) == 1);
  CHECK(pairs(1.99, with(wall, mirror)) == 1);
  CHECK(pairs(2.01, with(wall, mirror)) == 0);
  CHECK(pairs(0.1, with(wall, metal(0.8, 0.005))) == 0);
  CHECK(pairs(0.1, with(wall, clear)) == 0);
  CHECK(pairs(0.1, with(wall, mirror), by_light_sampling) == 0);
  // The light is above this block and beside it: the upper face sends its light upward, where nothing is.
  const Change block = with(Box<>{{2, 1, -1}, {3, 2, 1}}, mirror);
  CHECK(pairs(0.1, block) == 1);
  CHECK(pairs(0.1, block, with(Quad<>{{-6, 6, -6}, {12, 0, 0}, {0, 0, 12}}, matt)) == 2);
  CHECK(pairs(0.1, with(Box<>{{-7, -1, -7}, {7, 9, 7}}, mirror)) == 6);  // around it
}

TEST_CASE("specular pairs: flat mirrors that another surface covers, even in part, are left to scattering") {
  const auto mirrors = [](const Change& change) {  // it stands on the floor
    const Change wall = with(Quad<>{{-3, 0, -4}, {6, 0, 0}, {0, 4, 0}}, mirror);
    return specular_of(0.1, {0, 4, 0}, {wall, change}).flats.size();
  };
  const auto picture = [](double z) { return Quad<>{{-1, 1, z}, {1, 0, 0}, {0, 1, 0}}; };
  CHECK(mirrors([](Scene&) {}) == 1);
  CHECK(mirrors(with(picture(-4), matt)) == 0);
  CHECK(mirrors(with(picture(-3.999), matt)) == 1);
  CHECK(mirrors(with(picture(-4), metal(0.5, 0))) == 0);
  CHECK(mirrors(with(Quad<>{{3, 1, -4}, {1, 0, 0}, {0, 1, 0}}, matt)) == 1);   // beside it
  CHECK(mirrors(with(Quad<>{{-1, 1, -5}, {1, 0, 0}, {0, 0, 3}}, matt)) == 1);  // a shelf
  CHECK(mirrors(with(Box<>{{-9, -1, -4}, {9, 9, 9}}, matt)) == 0);
}

TEST_CASE("specular pairs: which slabs take part") {
  const Box<> upright{{-2, 0.01, -1.1}, {3, 3, -0.9}};
  const auto slabs = [&](
                         double light_radius, double index, const Change& change = [](Scene&) {}) {
    return specular_of(light_radius, {0.5, 1.5, -3}, {with(upright, glass(index)), change}).flats.size();
  };
  CHECK(slabs(0.1, 1.5) == 1);
  CHECK(slabs(0.9, 1.5) == 1);
  CHECK(slabs(1.1, 1.5) == 0);   // 1.9 away
  CHECK(slabs(0.1, 1.41) == 0);  // light leaves by the narrow sides
  CHECK(slabs(0.1, 1.42) == 1);
  CHECK(slabs(0.1, 0.6) == 0);
  const auto beside = [&](const Change& change) { return slabs(0.1, 1.5, change); };
  CHECK(beside(by_light_sampling) == 0);
  CHECK(beside(by_chance) == 0);
  // What reaches into it, and what does not.
  CHECK(beside(with(sphere({0, 1, 0}, 0.95), matt)) == 0);
  CHECK(beside(with(sphere({0, 1, 0}, 0.85), matt)) == 1);
  CHECK(beside(with(Sphere<>{{0, 1, 0}, 0.5, Vec3d{0, 1, -2}}, matt)) == 0);
  CHECK(beside(with(sphere({0, 1, 0}, 9), glass(1.2))) == 1);  // around all of it
  CHECK(beside(with(Quad<>{{0, 1, -1}, {1, 0, 0}, {0, 1, 0.2}}, matt)) == 0);
  CHECK(beside(with(Quad<>{{0, 1, -0.9}, {1, 0, 0}, {0, 1, 0.2}}, matt)) == 1);
  CHECK(beside(with(Box<>{{0, 1, -1.2}, {1, 2, 2}}, matt)) == 0);
  CHECK(beside(with(Box<>{{-9, -1, -9}, {9, 9, 9}}, matt)) == 1);
  CHECK(beside(fog(Box<>{{-5, 0, -5}, {5, 5, 5}})) == 1);
  CHECK(beside(fog(Box<>{{-5, 0, -1}, {5, 5, 5}})) == 0);
  CHECK(beside(fog(sphere({0, 1, 4}, 3))) == 1);
}

TEST_CASE("specular pairs: faces of a slab that something touches are closed, and no others") {
  const auto closed = [](
                          double low, const Change& change = [](Scene&) {}) {
    const Change slab = with(Box<>{{-2, low, -1.1}, {3, 3, -0.9}}, clear);
    const SpecularPairs specular = specular_of(0.1, {0.5, 1.5, -3}, {slab, change});
    REQUIRE(specular.flats.size() == 1);
    return specular.flats[0].closed;
  };
  CHECK(closed(0.01) == 0);
  CHECK(closed(0) == 1 << 2);                                                             // the floor
  CHECK(closed(0.01, with(Quad<>{{0, 1, -0.9}, {1, 0, 0}, {0, 1, 0}}, matt)) == 1 << 5);  // a label on it
  CHECK(closed(0.01, with(Box<>{{-3, 0.5, -2}, {-2, 4, 0}}, matt)) == 1 << 0);
}

}  // namespace tyndall::test::specular_pairs_test

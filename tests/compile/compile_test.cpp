#include "core/compile/compile.h"

#include "tests/support/mixed_scene.h"
#include "tests/support/scaled_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace tyndall::test::compile_test {

namespace {

Scene one_material(std::vector<Object> objects) {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = std::move(objects);
  return scene;
}

Object ball(Vec3d center, double radius = 1) { return {"", Solid3d{Sphere<>{center, radius, {}}, 0}, {}}; }
Object fog(std::variant<Sphere<>, Box<>> boundary, double density = 1, double g = 0) {
  return {"", Volume{boundary, {}, {density, g}, Vec3d{1, 1, 1}}, {}};
}

/// A mixture, seen in a small picture.
Scene small_mixture(Engine& engine, int count) {
  Scene scene = mixed_scene(engine, {.count = count, .middle = {}});
  scene.width = 64, scene.height = 48;
  return scene;
}

/// Whether two compiled scenes have the same origin and picture, to the last bit.
bool same(const RenderScene& a, const RenderScene& b) {
  const RenderOptions options{.threads = 1, .isa = "scalar", .spp = 2};
  return a.origin == b.origin && a.features == b.features && render(a, options).film == render(b, options).film;
}

}  // namespace

TEST_CASE("compile: a scene 100,000 units away keeps its digits") {
  Engine engine(2);
  const Scene scene = mixed_scene(engine, {.count = 100, .middle = {}});
  const RenderScene here = compile(scene), there = compile(moved(scene, {1e5, 1e5, -1e5}));
  double maximum = 0;
  for (std::size_t i = 0; i < here.spheres.center.x.size(); ++i)
    maximum = std::max(maximum, std::abs(static_cast<double>(here.spheres.center.x[i]) -
                                         static_cast<double>(there.spheres.center.x[i])));
  for (std::size_t i = 0; i < here.quads.map.size(); ++i)
    maximum = std::max(maximum, std::abs(static_cast<double>(here.quads.map[i].offset[2]) -
                                         static_cast<double>(there.quads.map[i].offset[2])));
  CHECK(maximum < 1e-6);
}

TEST_CASE("compile: the origin is the median of the centres, which outliers do not drag away") {
  Scene scene =
      one_material({ball({1, 2, 3}), ball({2, 3, 1}), ball({3, 1, 2}), ball({1e6, 1e6, 1e6}), ball({2, 2, 2})});
  CHECK(compile(scene).origin == Vec3d{2, 2, 2});
  scene.objects = {fog(Sphere<>{{7, 8, 9}, 1, {}})};
  CHECK(compile(scene).origin == Vec3d{7, 8, 9});
  scene.objects.clear();
  scene.camera.look_from = {4, 5, 6};
  CHECK(compile(scene).origin == Vec3d{4, 5, 6});
  CHECK(compile(scene).primitives() == 0);
}

TEST_CASE("compile: is a pure function of the scene, with an earlier result or without") {
  Engine engine(3);
  for (const int count : {5, 60}) {
    const Scene scene = small_mixture(engine, count);
    const RenderScene first = compile(scene);
    CHECK(same(first, compile(scene)));
    CHECK(same(first, compile(scene, &first)));
    const RenderScene other = compile(small_mixture(engine, 40));
    CHECK(same(first, compile(scene, &other)));
  }
}

TEST_CASE("compile: the tree is kept when the geometry is equal, and built anew when it is not") {
  Engine engine(4);
  const Scene scene = small_mixture(engine, 60);
  const RenderScene before = compile(scene);
  REQUIRE_FALSE(before.bvh.nodes.empty());
  const auto keeps = [&](const std::function<void(Scene&)>& edit) {
    Scene edited = scene;
    edit(edited);
    const RenderScene after = compile(edited, &before);
    CHECK(same(after, compile(edited)));
    return after.bvh.nodes.begin() == before.bvh.nodes.begin();
  };
  CHECK(keeps([](Scene&) {}));
  CHECK(keeps([](Scene& s) { s.materials[0] = {"gold", Vec3d{1, 0.8, 0.2}, Metal<>{0.3}}; }));
  CHECK(keeps([](Scene& s) { s.camera.look_from = {1, 2, 30}, s.camera.vfov = 20, s.camera.defocus_angle = 1; }));
  CHECK(keeps([](Scene& s) { s.render.seed = 7, s.background = Gradient{}, s.width = 10; }));
  CHECK(keeps([](Scene& s) { s.objects[0].name = "renamed"; }));
  // A medium is not in the tree, but it could move the origin. This one does not: it stands at the origin.
  CHECK(keeps([&](Scene& s) { s.objects.push_back(fog(Sphere<>{before.origin, 1, {}})); }));
  const auto sphere = [](Scene& s) -> Sphere<>& {
    return std::get<Sphere<>>(std::get<Solid3d>(s.objects[0].kind).shape);
  };
  CHECK_FALSE(keeps([&](Scene& s) { sphere(s).radius *= 1.01; }));
  CHECK_FALSE(keeps([&](Scene& s) { sphere(s).center.x += 0.01; }));
  CHECK_FALSE(keeps([](Scene& s) { s.objects[1].transform = {Translate{{0, 0.01, 0}}}; }));
  CHECK_FALSE(keeps([](Scene& s) { s.objects.pop_back(); }));
  CHECK_FALSE(keeps([](Scene& s) { std::swap(s.objects[0], s.objects[3]); }));
  CHECK_FALSE(keeps([](Scene& s) { s.camera.shutter_close = 2; }));  // moving spheres reach farther
}

TEST_CASE("compile: few primitives are tested one by one, more get a tree") {
  std::vector<Object> objects;
  for (int i = 0; i < 16; ++i) objects.push_back(ball({3.0 * i, 0, 0}));
  CHECK(compile(one_material(objects)).bvh.nodes.empty());
  objects.push_back(fog(Box<>{}));  // a medium is not a primitive
  CHECK(compile(one_material(objects)).bvh.nodes.empty());
  objects.push_back(ball({0, 9, 0}));
  CHECK_FALSE(compile(one_material(objects)).bvh.nodes.empty());
}

TEST_CASE("compile: needs name what is in the scene, and nothing else") {
  const auto features_of = [](const Scene& scene) {
    std::string all;
    for (const std::string& name : names_of(compile(scene).features)) all += name + " ";
    return all;
  };
  Scene scene;
  CHECK(features_of(scene).empty());
  scene.background = Vec3d{0, 0, 0.1};
  scene.textures = {{"chess", Checker<>{}}, {"unused", Noise<>{}}};
  scene.materials = {{"unused", Vec3d{1, 1, 1}, Metal<>{}},
                     {"matt", Vec3d{1, 1, 1}, Lambertian<>{}},
                     {"lamp", TextureIndex{0}, Light<>{}},
                     {"glass", TextureIndex{0}, Dielectric<>{}}};  // glass has no colour: its texture is not needed
  CHECK(features_of(scene) == "background ");
  scene.objects = {ball({})};
  std::get<Solid3d>(scene.objects[0].kind).material = 3;
  CHECK(features_of(scene) == "spheres dielectric background ");
  scene.objects.push_back({"", Solid3d{Quad<>{}, 2}, {}});
  CHECK(features_of(scene) == "spheres quads dielectric lights textures background ");
  scene.camera.shutter_close = 1;  // the shutter is not needed, because nothing moves
  CHECK(features_of(scene) == "spheres quads dielectric lights textures background ");
  scene.objects.push_back({"", Solid3d{Sphere<>{{}, 1, Vec3d{1, 0, 0}}, 1}, {}});
  CHECK(features_of(scene) == "spheres moving_spheres quads lambertian dielectric lights textures background shutter ");
  scene = {};
  scene.objects = {fog(Sphere<>{}, 0)};
  CHECK(features_of(scene).empty());
  scene.objects = {fog(Sphere<>{}, 2)};
  CHECK(features_of(scene) == "media ");
  scene.objects.push_back(fog(Box<>{}, 2, 0.5));
  CHECK(features_of(scene) == "media phase_functions ");
  scene.camera.defocus_angle = 0.1;
  CHECK(features_of(scene) == "media phase_functions lens ");
  scene.textures = {{"planet", Image{"planet.png", std::make_shared<Image::Pixels>(Image::Pixels{1, 1, {1, 2, 3}})}}};
  scene.materials = {{"planet", TextureIndex{0}, Lambertian<>{}}};
  CHECK(features_of(scene) == "media phase_functions lens ");
  scene.objects.push_back(ball({}));
  CHECK(features_of(scene) == "spheres media phase_functions lambertian textures image_textures lens ");
}

TEST_CASE("compile: a medium's elements are those of the shape it fills, else its own") {
  const Box<> box{{0, 0, 0}, {1, 1, 1}};
  Scene scene = one_material({ball({5, 0, 0}),
                              {"", Solid3d{box, 0}, {}},
                              fog(box, 3, 0.25),
                              fog(Sphere<>{{5, 0, 0}, 1, {}}),
                              fog(Sphere<>{{5, 0, 0}, 2, {}}),
                              fog(Box<>{{0, 0, 0}, {1, 1, 2}})});
  const RenderScene compiled = compile(scene);
  REQUIRE(compiled.media.size() == 4);
  const auto& m = compiled.media;
  CHECK(compiled.elements.count() == 7);  // the sphere, the box's faces
  CHECK((m[0].first == 1 && m[0].count == 6 && m[0].box && m[0].density == 3 && m[0].g == 0.25f));
  CHECK((m[1].first == 0 && m[1].count == 1 && !m[1].box));
  CHECK((m[2].first >= 7 && m[2].count == 1));
  CHECK((m[3].first >= m[2].first + m[2].count && m[3].count == 6));
  CHECK(m[0].map.row[0] ==
        compiled.boxes.map[0].row[0]);  // so the surface and its interior are computed alike, bit for bit
  CHECK(m[1].center == compiled.spheres.center[0]);
}

TEST_CASE("compile: elements name the object and the material, spheres keep their sign in the inverse radius") {
  Scene scene = one_material({ball({}, -0.5), {"", Group{{ball({4, 0, 0}, 2), {"", Solid3d{Box<>{}, 0}, {}}}}, {}}});
  const RenderScene compiled = compile(scene);
  const Elements& e = compiled.elements;
  REQUIRE(e.count() == 8);
  CHECK(e.inverse_radius[0] == -2.0f);
  CHECK(e.inverse_radius[1] == 0.5f);
  CHECK(e.inverse_radius[2] == 0.0f);
  CHECK(compiled.spheres.radius == std::vector<float>{0.5f, 2.0f});
  CHECK(compiled.object_of(0) == std::vector<int>{0});
  CHECK(compiled.object_of(1) == std::vector<int>{1, 0});
  CHECK(compiled.object_of(7) == std::vector<int>{1, 1});
  CHECK(compiled.boxes.element == std::vector<std::int32_t>{2});
}

TEST_CASE("compile: settings and materials arrive, the film's unit covers the brightest emitter") {
  Scene scene;
  scene.render.max_depth = 12;
  scene.render.seed = 99;
  scene.render.fresnel = FresnelKind::schlick;
  scene.background = Hemispheres{{1, 3, 2}, {0, 0, 0}};
  scene.textures = {{"grey", Solid<>{{0.5, 0.5, 0.5}}}};
  scene.materials = {{"gold", Vec3d{1, 0.75, 0.25}, Metal<>{0.125}},
                     {"glass", Vec3d{0.5, 0.5, 0.5}, Dielectric<>{1.5}},
                     {"grey", TextureIndex{0}, Lambertian<>{}}};
  RenderScene compiled = compile(scene);
  CHECK(compiled.max_depth == 12);
  CHECK(compiled.seed == 99);
  CHECK(compiled.schlick);
  CHECK(compiled.film_quantum == 4);
  CHECK(compiled.materials.parameter[0] == std::vector<float>{0.125f, 1.5f, 0});
  CHECK(compiled.materials.colour.x == std::vector<float>{1, 1, 1});  // glass and textures: as they are
  CHECK(compiled.materials.colour.z == std::vector<float>{0.25f, 1, 1});
  CHECK(compiled.materials.texture == std::vector<std::int32_t>{-1, -1, 0});
  CHECK(compiled.materials.kind == std::vector<std::int32_t>{1, 2, 0});
  scene.materials.push_back({"lamp", Vec3d{7, 2, 33}, Light<>{}});
  CHECK(compile(scene).film_quantum == 64);
}

}  // namespace tyndall::test::compile_test

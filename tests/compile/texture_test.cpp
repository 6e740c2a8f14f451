#include "core/base/math.h"
#include "core/compile/flatten.h"
#include "core/image/tonemap.h"
#include "core/targets/kernels.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace tyndall::test::texture_test {

namespace {

constexpr int edge = 64;

std::vector<FirstHit> seen(const RenderScene& scene, const Kernels& kernels = scalar_kernels()) {
  std::vector<FirstHit> hits(static_cast<std::size_t>(scene.width * scene.height));
  const SceneViewOf view(scene);
  kernels.first_hits(view.view(), {0, 0, scene.width, scene.height}, hits.data());
  return hits;
}

/// A camera straight above the wall z = 0, 3 units wide around `middle`; the wall has the texture.
Scene textured_wall(const TextureKinds<double>& texture, Vec3d middle) {
  Scene scene;
  scene.width = scene.height = edge;
  scene.textures = {{"texture", texture}};
  scene.materials = {{"wall", TextureIndex{0}, Lambertian<>{}}, {"plain", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.camera = {.look_from = middle + Vec3d{0, 0, 5}, .look_at = middle, .vfov = 2 * std::atan(1.5 / 5) * 180 / pi};
  scene.objects = {{"", Solid3d{Quad<>{middle - Vec3d{3, 3, 0}, {6, 0, 0}, {0, 6, 0}}, 0}, {}}};
  return scene;
}

/// Moves the compiled scene's origin elsewhere, by adding shapes there that are out of sight.
void drag_origin(Scene& scene, Vec3d to) {
  for (int i = 0; i < 4; ++i) scene.objects.push_back({"", Solid3d{Sphere<>{to, 0.01 + 1e-3 * i, {}}, 1}, {}});
}

/// The point of that wall that the middle of a pixel sees.
Vec3d point_at(std::size_t pixel, Vec3d middle) {
  const double x = static_cast<double>(pixel % edge) + 0.5, y = static_cast<double>(pixel / edge) + 0.5;
  return middle + Vec3d{3 * x / edge - 1.5, 1.5 - 3 * y / edge, 0};
}

struct Named {
  const char* name;
  TextureKinds<double> kind;
};
const Named world_textures[] = {
    {"checker", Checker<>{0.32, {0.2, 0.3, 0.1}, {0.9, 0.9, 0.9}}},
    {"perlin", Noise<>{4, Noise<>::Style::perlin}},
    {"turbulence", Noise<>{4, Noise<>::Style::turbulence}},
    {"marble", Noise<>{4, Noise<>::Style::marble}},
};

/// The definition, in double, in world space.
double reference(const TextureKinds<double>& kind, Vec3d p, const float* gradients) {
  if (const auto* checker = std::get_if<Checker<>>(&kind)) {
    const double sum =
        std::floor(p.x / checker->scale) + std::floor(p.y / checker->scale) + std::floor(p.z / checker->scale);
    return std::fmod(std::abs(sum), 2) == 1 ? checker->odd.x : checker->even.x;
  }
  const auto& noise = std::get<Noise<>>(kind);
  const double k = noise.style == Noise<>::Style::marble ? 1 : noise.scale;
  if (noise.style == Noise<>::Style::perlin) return 0.5 * (1 + gradient_noise(k * p, gradients));
  const double t = turbulence(k * p, true, gradients);
  return noise.style == Noise<>::Style::turbulence ? t : 0.5 * (1 + std::sin(noise.scale * p.z + 10 * t));
}

/// Red and green are u and v in steps of 1/256.
std::shared_ptr<const Image::Pixels> ramp() {
  auto pixels = std::make_shared<Image::Pixels>(Image::Pixels{256, 256, {}});
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      for (const int value : {column, 255 - row, 0})
        pixels->rgb.push_back(srgb_decode(static_cast<float>(value) / 255));
  return pixels;
}

/// u or v of a colour of that picture.
double coordinate(float linear) { return (255 * static_cast<double>(srgb_encode(linear)) + 0.5) / 256; }

}  // namespace

TEST_CASE("textures in world space: as defined, wherever the scene and its origin are") {
  for (const Named& texture : world_textures)
    for (const Vec3d middle : {Vec3d{0.7, 0.4, 0.31}, Vec3d{-731.3, 512.9, -1333.7}})
      for (const Vec3d away : {Vec3d{0, 0, 0}, Vec3d{20, -31, 45}, Vec3d{-300.3, 77.7, 99.9}}) {
        Scene scene = textured_wall(texture.kind, middle);
        if (length(away) > 0) drag_origin(scene, middle + away);
        const RenderScene compiled = compile(scene);
        REQUIRE(length(compiled.origin - middle - away) < 1e-6);
        const float* gradients = compiled.gradients;
        for (const Kernels& kernels : available_kernels()) {
          const std::vector<FirstHit> hits = seen(compiled, kernels);
          int wrong = 0, bright = 0;
          for (std::size_t i = 0; i < hits.size(); ++i) {
            const double expected = reference(texture.kind, point_at(i, middle), gradients);
            wrong += std::abs(static_cast<double>(hits[i].albedo.x) - expected) < 0.02 ? 0 : 1;
            bright += expected > 0.5 ? 1 : 0;
          }
          CAPTURE(std::string(texture.name));
          CAPTURE(std::string(kernels.isa));
          CAPTURE(away.x);
          CHECK(wrong <= edge * edge / 200);  // points on a checker's edge may be rounded to its other side
          if (std::string(texture.name) != "turbulence") CHECK((bright > 500 && bright < edge * edge - 500));
        }
      }
}

TEST_CASE("textures in world space: a pattern far away is the one near by, not another or none") {
  // The patterns repeat: perlin after 256 / scale, checkers after 2 scales.
  for (const Named& texture : world_textures) {
    if (std::string(texture.name) == "marble") continue;  // its veins' period is no whole number of its cells
    const bool checker = std::string(texture.name) == "checker";
    const double period = checker ? 0.64 : 64;
    const Vec3d here{0.7, 0.4, 0.31}, there = here + Vec3d{1000 * period, -2000 * period, 3000 * period};
    const auto a = seen(compile(textured_wall(texture.kind, here))),
               b = seen(compile(textured_wall(texture.kind, there)));
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += length(a[i].albedo - b[i].albedo) < 0.01f ? 0 : 1;
    CHECK(different <= edge * edge / 200);
  }
}

TEST_CASE("checker: on a flat in the border between cells rounding does not choose the cell") {
  const double scale = 0.32, beside = 1e-4;
  const auto shapes_at = [](double z) {
    return std::vector<Object>{
        {"", Solid3d{Quad<>{{-3, -3, z}, {6, 0, 0}, {0, 6, 0}}, 0}, {}},
        {"", Solid3d{Box<>{{-3, -3, z - 1}, {3, 3, z}}, 0}, {}},
        {"", Solid3d{Box<>{{-z, -3, -3}, {1 - z, 3, 3}}, 0}, {RotateY{90}}},
    };
  };
  for (const int cell : {0, 1, -3, 7, -10})
    for (const Vec3d away : {Vec3d{0, 0, 0}, Vec3d{0.7321, 0.4113, -0.3779}})
      for (std::size_t shape = 0; shape < 3; ++shape) {
        Scene scene = textured_wall(Checker<>{scale, {0, 0, 0}, {1, 1, 1}}, {0, 0, cell * scale});
        scene.camera.look_from = {2.1, -1.3, cell * scale + 3.7};
        scene.objects = {shapes_at(cell * scale)[shape]};
        if (length(away) > 0) drag_origin(scene, away);
        Scene moved = scene;
        moved.objects[0] = shapes_at(cell * scale + beside)[shape];
        for (const Kernels& kernels : available_kernels()) {
          const auto found = seen(compile(scene), kernels), expected = seen(compile(moved), kernels);
          int wrong = 0, odd = 0;
          for (std::size_t i = 0; i < found.size(); ++i) {
            wrong += found[i].albedo.x == expected[i].albedo.x ? 0 : 1;
            odd += found[i].albedo.x == 1.0f ? 1 : 0;
          }
          CAPTURE(cell);
          CAPTURE(shape);
          CHECK(wrong <= edge * edge / 200);  // along the borders within the flat
          CHECK(odd > edge * edge / 4);
          CHECK(odd < edge * edge * 3 / 4);
        }
      }
}

TEST_CASE("images: u and v of quads run along their edges, wherever the origin is") {
  const Quad<> quad{{-1, -1, 0}, {2, 0, 0}, {0.5, 2, 0}};
  for (const Vec3d away : {Vec3d{0, 0, 0}, Vec3d{40, 30, -20}}) {
    Scene scene = textured_wall(Image{"ramp", ramp()}, {});
    std::get<Solid3d>(scene.objects[0].kind).shape = quad;
    if (length(away) > 0) drag_origin(scene, away);
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<FirstHit> hits = seen(compile(scene), kernels);
      int wrong = 0, met = 0;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const Vec3d p = point_at(i, {});
        const double v = (p.y + 1) / 2, u = (p.x + 1 - 0.5 * v) / 2;
        if (std::min({u, v, 1 - u, 1 - v}) < 0.01) continue;
        ++met;
        wrong += std::abs(coordinate(hits[i].albedo.x) - u) < 0.003 ? 0 : 1;
        wrong += std::abs(coordinate(hits[i].albedo.y) - v) < 0.003 ? 0 : 1;
      }
      CHECK(wrong == 0);
      CHECK(met > 1000);
    }
  }
}

TEST_CASE("images: on each face of a box u runs to the right and v up, as seen from outside") {
  struct Face {
    Vec3d normal, u, v;
  };
  // The sides stand upright; the top has v towards -z, the bottom towards z (The Next Week, section 8.1).
  const Face faces[6] = {{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},  {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                         {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},  {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                         {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  const Vec3d half{1, 2, 3}, middle{5, 6, 7};
  for (const double degrees : {0.0, 90.0, 25.0})
    for (int f = 0; f < 6; ++f) {
      const Face& face = faces[f];
      CHECK(cross(face.u, face.v) == face.normal);
      Scene scene = textured_wall(Image{"ramp", ramp()}, {});
      scene.width = scene.height = 1;
      scene.objects = {{"", Solid3d{Box<>{middle - half, middle + half}, 0}, {RotateY{degrees}, Translate{{3, 0, 0}}}}};
      const Placement placement{degrees, {3, 0, 0}};
      for (const Vec3d uv : {Vec3d{0.5, 0.5, 0}, Vec3d{0.1, 0.2, 0}, Vec3d{0.9, 0.3, 0}, Vec3d{0.2, 0.8, 0}}) {
        const Vec3d on = half * (face.normal + (2 * uv.x - 1) * face.u + (2 * uv.y - 1) * face.v);
        scene.camera = {.look_from = place(placement, middle + on + 4.0 * face.normal),
                        .look_at = place(placement, middle + on),
                        .vup = {0.1, 0.9, 0.3},
                        .vfov = 0.001};
        for (const Kernels& kernels : available_kernels()) {
          const FirstHit hit = seen(compile(scene), kernels)[0];
          CAPTURE(f);
          CHECK(hit.element == f);
          CHECK(std::abs(coordinate(hit.albedo.x) - uv.x) < 0.003);
          CHECK(std::abs(coordinate(hit.albedo.y) - uv.y) < 0.003);
        }
      }
    }
}

TEST_CASE("images: on spheres by longitude and latitude of their own frame, also turned, moving and inverted") {
  struct Case {
    double radius, degrees;
    bool moves;
  };
  for (const Case& c : {Case{1, 0, false}, Case{1, 50, false}, Case{-1, 50, false}, Case{1, -120, true}}) {
    Scene scene = textured_wall(Image{"ramp", ramp()}, {});
    Sphere<> sphere{{0, 0, 0}, c.radius, {}};
    if (c.moves) sphere.center_end = Vec3d{0, 0, 0.8};  // turned with the sphere
    scene.objects = {{"", Solid3d{sphere, 0}, {RotateY{c.degrees}}}};
    if (c.moves) scene.camera.shutter_close = 1;
    const RenderScene compiled = compile(scene);
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<FirstHit> hits = seen(compiled, kernels);
      int wrong = 0, met = 0;
      for (const FirstHit& hit : hits) {
        if (hit.element < 0) continue;
        const Vec3d n{hit.normal.x, hit.normal.y, hit.normal.z};
        const Vec3d own = rotate({-c.degrees, {}}, (c.radius < 0 ? -1.0 : 1.0) * n);
        const double u = (std::atan2(-own.z, own.x) + pi) / (2 * pi), v = std::acos(-own.y) / pi;
        if (std::min({u, v, 1 - u, 1 - v}) < 0.02) continue;
        ++met;
        wrong += std::abs(coordinate(hit.albedo.x) - u) < 0.004 ? 0 : 1;
        wrong += std::abs(coordinate(hit.albedo.y) - v) < 0.004 ? 0 : 1;
      }
      CHECK(wrong == 0);
      CHECK(met > 800);
    }
  }
}

TEST_CASE("images: a compiled scene has the scene's own pixels, no copy") {
  const Scene scene = textured_wall(Image{"ramp", ramp()}, {});
  CHECK(compile(scene).textures[0].pixels == std::get<Image>(scene.textures[0].kind).pixels);
}

TEST_CASE("textures: a picture lies on a disk by radius and angle, on a triangle as on its quad") {
  const auto ramp = [](int width, int height) {  // grey from 0 at the left or the bottom to 1
    auto pixels = std::make_shared<Image::Pixels>();
    pixels->width = width, pixels->height = height;
    for (int i = 0; i < 4; ++i) pixels->rgb.insert(pixels->rgb.end(), 3, static_cast<float>(width > 1 ? i : 3 - i) / 3);
    return Image{"ramp", pixels};
  };
  const auto expected = [](double along) { return std::clamp(4 * along - 0.5, 0.0, 3.0) / 3; };
  for (const bool across : {true, false})
    for (const bool is_disk : {true, false}) {
      Scene scene = textured_wall(across ? ramp(4, 1) : ramp(1, 4), {});
      auto& shape = std::get<Solid3d>(scene.objects[0].kind).shape;
      if (is_disk)
        shape = Disk<>{{0, 0, 0}, {1.4, 0, 0}, {0, 1.4, 0}, 0.2};
      else
        shape = Triangle<>{{-1.4, -1.4, 0}, {2.79, 0, 0}, {0, 2.79, 0}};  // no pixel's middle is on an edge
      const std::vector<FirstHit> hits = seen(compile(scene));
      int met = 0;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].element < 0) continue;
        const Vec3d p = point_at(i, {});
        const double angle = std::atan2(p.y, p.x) / (2 * pi);
        const double on_disk = across ? std::hypot(p.x, p.y) / 1.4 : angle < 0 ? angle + 1 : angle;
        const double on_triangle = ((across ? p.x : p.y) + 1.4) / 2.79;
        CHECK(static_cast<double>(hits[i].albedo.x) ==
              doctest::Approx(expected(is_disk ? on_disk : on_triangle)).epsilon(1e-4));
        ++met;
      }
      const double area = is_disk ? pi * 1.4 * 1.4 * (1 - 0.04) : 0.5 * 2.79 * 2.79;
      CHECK(met == doctest::Approx(area / 9 * edge * edge).epsilon(0.02));
    }
}

}  // namespace tyndall::test::texture_test

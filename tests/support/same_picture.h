#pragma once
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Scenes of all kinds, whether threads and tiles change a bit of their pictures, and whether parts of pictures of
/// random scenes have the bits of the whole: regions, shards and continued films.
namespace tyndall::test {

/// Random scenes in which most light takes specular paths. A floor, sometimes walls, and 3 to 7 things: solid and
/// hollow glass, some of it filled with media or with a light, mirrors (spheres, quads, boxes), slabs of glass, matt
/// and brushed spheres with textures, moving spheres; one to three lights of all sizes; sometimes media around all of
/// it. A pure function of the seed.
class RandomGlass {
 public:
  explicit RandomGlass(unsigned seed) : engine_(seed) {}

  Scene scene(int width, int height) {
    scene_.width = width, scene_.height = height;
    scene_.render.max_depth = 50;
    Camera& camera = scene_.camera;
    camera.look_from = {between(-3, 3), between(0.3, 4), between(3, 8)};
    camera.look_at = {between(-1, 1), between(0.2, 1.2), between(-1, 1)};
    camera.vfov = between(20, 60);
    camera.shutter_close = chance(0.3) ? 1 : 0;
    if (chance(0.3)) scene_.background = Vec3d{between(0, 0.5), between(0, 0.5), between(0, 0.5)};
    add_textures();
    add(Quad<>{{-20, 0, -20}, {40, 0, 0}, {0, 0, 40}}, matt());
    if (chance(0.4)) add(Quad<>{{-8, 0, -4}, {16, 0, 0}, {0, 8, 0}}, chance(0.3) ? mirror() : matt());
    for (int i = 3 + below(5); i > 0; --i) add_thing();
    for (int i = 1 + below(3); i > 0; --i) add_light({between(-3, 3), between(1.5, 5), between(-3, 3)});
    if (chance(0.25)) add_medium(Box<>{{-6, 0, -6}, {6, 6, 6}}, {}, between(0.01, 0.2));
    return scene_;
  }

 private:
  Scene scene_;
  std::mt19937 engine_;  ///< the same with every standard library

  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32; }
  bool chance(double probability) { return between(0, 1) < probability; }
  /// 0 ... count - 1.
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  /// A colour of a surface, in [0.1, 0.95).
  Vec3d colour() {
    const double red = between(0.1, 0.95), green = between(0.1, 0.95);
    return {red, green, between(0.1, 0.95)};
  }

  double an_index() {
    constexpr double some[] = {1.5, 1.33, 2.4, 1.05, 1 / 1.5, 1 / 1.33, 0.9};
    return chance(0.7) ? some[below(7)] : between(0.5, 2.5);
  }

  void add_textures() {
    scene_.textures.push_back({"checker", Checker<>{between(0.1, 1), colour(), colour()}});
    scene_.textures.push_back({"noise", Noise<>{between(0.5, 5), static_cast<NoiseStyle>(below(3))}});
    Image::Pixels pixels{5, 3, {}};
    for (int i = 0; i < 5 * 3 * 3; ++i) pixels.rgb.push_back(static_cast<float>(between(0, 1)));
    scene_.textures.push_back({"image", Image{"image.png", std::make_shared<const Image::Pixels>(pixels)}});
  }
  ColourOrTexture colour_or_texture(int textures) {
    if (chance(0.6)) return colour();
    return TextureIndex{below(textures)};
  }
  Material matt() { return {"", colour_or_texture(3), Lambertian<>{}}; }
  Material mirror() { return {"", chance(0.5) ? colour_or_texture(3) : Vec3d{0.9, 0.9, 0.9}, Metal<>{0}}; }
  Material glass(double index) { return {"", Vec3d{1, 1, 1}, Dielectric<>{index}}; }

  template <class Shape>
  void add(const Shape& shape, Material material, Transform transform = {}) {
    const auto index = static_cast<int>(scene_.materials.size());
    material.name = "m" + std::to_string(index);
    scene_.materials.push_back(std::move(material));
    scene_.objects.push_back({"", Solid3d{shape, index}, std::move(transform)});
  }
  template <class Shape>
  void add_medium(const Shape& boundary, Transform transform, double density) {
    Volume fog;
    fog.boundary = boundary, fog.boundary_transform = std::move(transform);
    fog.medium = {density, chance(0.5) ? 0 : between(-0.8, 0.8)};
    fog.albedo = chance(0.2) ? ColourOrTexture{Vec3d{0, 0, 0}} : colour_or_texture(2);
    scene_.objects.push_back({"", fog, {}});
  }

  void add_thing() {
    const double size = between(0.2, 0.9);
    const Vec3d at{between(-3, 3), chance(0.7) ? size : between(size, 2), between(-3, 2)};
    const double kind = between(0, 1);
    if (kind < 0.2) return add_sphere(at, size);
    if (kind < 0.5) return add_shell(at, size);
    if (kind < 0.62) return add_mirror(at, size);
    if (kind < 0.8) return add_slab(at, size);
    const bool brushed = chance(0.4);
    add(Sphere<>{at, size, moved(at)}, brushed ? Material{"", colour(), Metal<>{between(0.02, 1)}} : matt());
  }
  std::optional<Vec3d> moved(Vec3d at) {
    if (scene_.camera.shutter_close == 0 || chance(0.5)) return std::nullopt;
    return at + Vec3d{between(-0.3, 0.3), between(0, 0.3), between(-0.3, 0.3)};
  }
  void add_sphere(Vec3d at, double size) {
    const Sphere<> ball{at, size, moved(at)};
    add(ball, glass(an_index()));
    if (!ball.center_end && chance(0.3)) add_medium(ball, {}, between(0.1, 5));
    if (!ball.center_end && chance(0.15)) add_light(at, 0.2 * size);
  }
  /// The second sphere is as the books write hollow glass, or by a relative index, or of something else.
  void add_shell(Vec3d at, double size) {
    const double index = an_index(), inner = size * between(0.3, 0.98), kind = between(0, 1);
    const std::optional<Vec3d> end = moved(at);
    add(Sphere<>{at, size, end}, glass(index));
    if (kind < 0.5)
      add(Sphere<>{at, -inner, end}, glass(index));
    else
      add(Sphere<>{at, inner, end}, glass(kind < 0.8 ? 1 / index : an_index()));
    if (!end && chance(0.2)) add_light(at, 0.3 * inner);
  }
  void add_mirror(Vec3d at, double size) {
    const double kind = between(0, 1), turn = between(-180, 180);
    if (kind < 0.4) return add(Sphere<>{at, size, moved(at)}, mirror());
    if (kind < 0.8) return add(Quad<>{{-size, 0, 0}, {2 * size, 0, 0}, {0, 2 * size, 0}}, mirror(), placed(turn, at));
    add(Box<>{{-size, 0, -size}, {size, size, size}}, mirror(), placed(turn, at));
  }
  void add_slab(Vec3d at, double size) {
    const Box<> slab{{-size, 0, -between(0.02, 0.5) * size}, {size, between(0.5, 3) * size, size * between(0.02, 0.5)}};
    const Transform place = placed(chance(0.3) ? 0 : between(-180, 180), at);
    add(slab, glass(between(1.3, 2)), place);
    if (chance(0.3)) add_medium(slab, place, between(0.1, 5));
  }
  static Transform placed(double turn, Vec3d at) { return {RotateY{turn}, Translate{at}}; }

  /// All lights have about the same power, however small they are.
  void add_light(Vec3d at) { add_light(at, std::exp(between(std::log(0.01), std::log(0.8)))); }
  void add_light(Vec3d at, double size) {
    const double radiance = between(1, 6) / (size * size);
    const Material lamp{"", Vec3d{radiance, between(0.6, 1) * radiance, between(0.4, 1) * radiance}, Light<>{}};
    if (chance(0.6)) return add(Sphere<>{at, size, {}}, lamp);
    add(Quad<>{at, {size, 0, 0}, {0, between(-0.5, 0.5) * size, size}}, lamp);
  }
};

namespace same_picture {

inline constexpr int width = 61, height = 43;  // neither is a multiple of a tile's edge

inline const std::vector<RenderScene>& scenes() {
  static const std::vector<RenderScene> all = [] {
    std::vector<RenderScene> list;
    for (const char* name : {"showroom", "cornell-smoke", "bouncing-spheres", "next-week", "stress-caustic-glass",
                             "stress-caustic-shell", "stress-mirror-wall", "stress-pane", "stress-two-balls"})
      list.push_back(compile(small_scene(name, width, height, 1)));
    for (const char* name : {"cornell-box", "cornell-smoke"}) list.push_back(compile(close_up(name, width, height)));
    list.push_back(compile(caustic_close_up(width, height)));
    const auto reuses_paths = [](const RenderScene& scene) { return SceneViewOf(scene).view().reuses_paths; };
    CHECK(std::count_if(list.begin(), list.end(), reuses_paths) == 4);
    return list;
  }();
  return all;
}

inline RenderOptions options_of(const Kernels& kernels, std::uint32_t spp) {
  return {.threads = 2, .isa = kernels.isa, .spp = spp};
}

/// Renders the scene on one thread, then with each of these numbers of threads and edges of tiles.
inline void check_threads_and_tiles(const std::vector<std::pair<int, int>>& threads_and_tiles) {
  for (const Kernels& kernels : available_kernels())
    for (const RenderScene& scene : scenes()) {
      CAPTURE(kernels.isa);
      RenderOptions options = options_of(kernels, 5);
      options.threads = 1;
      const Film reference = render(scene, options).film;
      CHECK(totals(reference).rejected == 0);
      for (const auto& [threads, tile] : threads_and_tiles) {
        options.threads = threads;
        options.tile = tile;
        const Film film = render(scene, options).film;
        REQUIRE(film == reference);
        REQUIRE(hash_of(film) == hash_of(reference));
      }
    }
}

struct CutPictures {
  int pairs = 0;      ///< how many parts were compared with the whole
  int differ = 0;     ///< of these, how many have other bits
  int chained = 0;    ///< scenes that have specular light paths to solve for
  unsigned last = 0;  ///< seed of the last scene that differs
};

/// Compares whole pictures of the scene of this seed with two regions, with two shards, and with a film that was gone
/// on with, by the given kernels.
inline void compare_cuts(unsigned seed, const Kernels& kernels, CutPictures& found) {
  std::mt19937 engine(seed);
  Scene source = RandomGlass(seed).scene(24, 20);
  if (engine() % 2) source.render.sampler = SamplerKind::random;
  const RenderScene scene = compile(source);
  found.chained += !scene.specular.sphere.empty() ? 1 : 0;
  RenderOptions options{.threads = 1, .isa = kernels.isa, .spp = 8};
  const Film whole = render(scene, options).film;
  const auto count = [&](bool same) {
    ++found.pairs;
    if (!same) ++found.differ, found.last = seed;
  };
  for (int round = 0; round < 2; ++round) {
    const auto below = [&](int end) { return static_cast<int>(engine() % static_cast<unsigned>(end)); };
    const int x = below(23), y = below(19);
    options.region = Region{x, y, x + 1 + below(24 - x), y + 1 + below(20 - y)};
    const Film part = render(scene, options).film;
    bool same = true;
    for (int row = options.region->y0; row < options.region->y1; ++row)
      for (int column = options.region->x0; column < options.region->x1; ++column)
        same = same && part.at(column, row) == whole.at(column, row);
    count(same);
  }
  options.region.reset();
  options.spp = 3;
  const Film first = render(scene, options).film;
  options.spp = 5, options.first_sample = 3;
  count(merged({{"first", first}, {"second", render(scene, options).film}}) == whole);
  options.spp = 8, options.first_sample = 0;
  count(render(scene, options, {}, first).film == whole);
}

/// Checks that the parts of `count` scenes, from seed `first` on, have the bits of the whole, with every instruction
/// set.
inline void check_cuts(unsigned first, int count) {
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(std::string(kernels.isa));
    CutPictures found;
    for (int i = 0; i < count; ++i) compare_cuts(first + static_cast<unsigned>(i), kernels, found);
    CAPTURE(found.last);
    CHECK(found.pairs == 4 * count);
    CHECK(found.differ == 0);
    CHECK(found.chained >= 3 * count / 4);
  }
}

}  // namespace same_picture
}  // namespace tyndall::test

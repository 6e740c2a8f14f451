#include "core/scene/check.h"
#include "tests/support/probe.h"
#include "tests/support/skies.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <functional>

/// Whatever a slider is dragged to, the picture has no rejected samples, is not of one colour, and shows no light that
/// comes from nowhere.
namespace tyndall::test::sliders_test {

namespace {

/// The ends, the middle and three more values of what a slider offers.
std::vector<double> values_of(const Slider& slider, Engine& engine) {
  std::vector<double> parts{0, 1, 0.5, uniform(engine, 0, 1), uniform(engine, 0, 1), uniform(engine, 0, 1)};
  for (double& part : parts)
    part = slider.logarithmic ? slider.low * std::pow(slider.high / slider.low, part)
                              : slider.low + part * (slider.high - slider.low);
  return parts;
}

/// What sets a field to each of those values; of a vector, one axis at a time.
template <class T>
std::vector<std::function<void(T&)>> setters(const Slider& slider, Engine& engine) {
  std::vector<std::function<void(T&)>> list;
  if constexpr (std::is_same_v<T, double>) {
    for (const double v : values_of(slider, engine)) list.push_back([v](double& value) { value = v; });
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z})
      for (const double v : values_of(slider, engine)) list.push_back([=](Vec3d& value) { value.*axis = v; });
  } else if constexpr (requires(T value) { value.reset(); }) {
    list.push_back([](T& value) { value.reset(); });
    for (const auto& set : setters<typename T::value_type>(slider, engine))
      list.push_back([set](T& value) {
        if (!value) value.emplace();
        set(*value);
      });
  }
  return list;
}

/// Calls `use` with copies of `owner`, in each of which one slider stands elsewhere.
template <class Owner, class Use>
void drag_each(const Owner& owner, const Use& use) {
  Engine engine(1);
  const auto drag = [&](const auto& field) {
    using Value = std::decay_t<decltype(owner.*field.value)>;
    // Places have no slider: they are dragged as far as the stage reaches.
    const Slider reach = has_slider(field.slider) ? field.slider : Slider{-10, 10};
    for (const auto& set : setters<Value>(reach, engine)) {
      Owner changed = owner;
      set(changed.*field.value);
      CAPTURE(field.name);
      use(changed);
    }
  };
  std::apply([&](const auto&... field) { (drag(field), ...); }, fields_of<Owner>());
}

/// A floor and a light, with room for the thing that is tested; light reaches every corner.
Scene stage() {
  Scene scene = white_room();
  scene.width = 24, scene.height = 18;
  scene.background = Gradient{{0.1, 0.1, 0.1}, {0.3, 0.4, 0.6}};
  scene.camera = {.look_from = {0, 2, 7}, .look_at = {0, 0.5, 0}, .vfov = 40};
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::sobol;
  scene.render.max_depth = 1000000;
  add(scene, Quad<>{{-5, -1, -5}, {10, 0, 0}, {0, 0, 10}}, lambertian(0.6));
  add(scene, Quad<>{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(3));
  return scene;
}

int pictures = 0;

/// Whether a scene would be refused, not rendered: a camera in what it looks at, an edge without length.
bool refused(Scene scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) scene.materials[i].name = std::to_string(i);
  return check(scene).has_value();
}

void check_stage(const Scene& scene) {
  if (refused(scene)) return;
  ++pictures;
  const Film film = film_of(scene, 2);
  const FilmTotals sum = totals(film);
  CHECK(sum.rejected == 0);
  CHECK(sum.truncated == 0);
  double mean_value = 0;
  int same = 0;
  for (const FilmPixel& pixel : film.pixels) {
    mean_value += static_cast<double>(mean(film, pixel).x) / static_cast<double>(film.pixels.size());
    same += mean(film, pixel) == mean(film, film.pixels[0]) ? 1 : 0;
  }
  CHECK(mean_value > 1e-4);
  CHECK(mean_value <= 3);  // the light
  // A picture of one colour only where everything seen is the light, or all is hidden by a sphere around the camera.
  CHECK((same < static_cast<int>(film.pixels.size()) || mean_value == 3 || mean_value < 1));
}

/// Checks that no pixel is above 1 when the same things are alone in a white room.
void check_furnace(Scene scene) {
  scene.background = Vec3d{1, 1, 1};
  scene.objects.erase(scene.objects.begin() + 1);  // the light
  if (refused(scene)) return;
  ++pictures;
  const Film film = film_of(scene, 2);
  CHECK(totals(film).rejected == 0);
  for (const FilmPixel& pixel : film.pixels) {
    REQUIRE(mean(film, pixel).x <= 1.00001f);
    REQUIRE(mean(film, pixel).x >= 0.0f);
  }
}

void check_both(const Scene& scene) {
  check_stage(scene);
  check_furnace(scene);
}

}  // namespace

TEST_CASE("sliders: of every material, on balls, hollow balls, boxes and quads") {
  const auto try_kind = [](const auto& kind) {
    drag_each(kind, [](const auto& changed) {
      for (const double radius : {1.0, -1.0}) {
        Scene scene = stage();
        add(scene, sphere({-1.2, 0, 0}, radius), {"", Vec3d{0.8, 0.6, 0.3}, changed});
        add(scene, Box<>{{0.3, -1, -0.7}, {1.5, 1, 0.5}}, {"", Vec3d{1, 1, 1}, changed}, {RotateY{20}});
        add(scene, Quad<>{{-2, -1, -2}, {4, 0, 0}, {0, 3, 0.5}}, {"", Vec3d{0.9, 0.9, 0.9}, changed});
        check_both(scene);
      }
    });
  };
  pictures = 0;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (try_kind(std::variant_alternative_t<i, MaterialKinds<double>>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<MaterialKinds<double>>>{});
  CHECK(pictures >= 2 * 2 * 2 * 6);
}

TEST_CASE("sliders: of media, alone, in glass, and around the camera") {
  pictures = 0;
  drag_each(Medium<>{0.5, 0.3}, [](const Medium<>& changed) {
    constexpr double albedos[] = {0.9, 0, 1};
    for (const double albedo : tried(albedos, 1))
      for (const double radius : {1.0, 9.0}) {
        Scene scene = stage();
        add_medium(scene, sphere({0, 0.2, 0}, radius), changed, albedo);
        if (radius == 1 && albedo < 1) add(scene, sphere({0, 0.2, 0}, radius), glass(1.5));
        if (radius == 1 || albedo == 1) check_stage(scene);
        check_furnace(scene);
      }
  });
  CHECK(pictures > (thorough() ? 60 : 20));
}

TEST_CASE("sliders: of the camera") {
  pictures = 0;
  Scene scene = stage();
  scene.camera.vup = {0.1, 1, 0.2};
  add(scene, sphere({-1.2, 0, 0}, 1), glass(1.5));
  add(scene, sphere({1.2, 0, 0}, 1), metal(0.8, 0.2));
  drag_each(scene.camera, [&](const Camera& camera) {
    scene.camera = camera;
    check_both(scene);
  });
  CHECK(pictures > 100);
}

TEST_CASE("sliders: of shapes, textures and the sky") {
  pictures = 0;
  const auto try_shape = [](const auto& shape) {
    drag_each(shape, [](const auto& changed) {
      for (const Material& material : {lambertian(0.7), glass(1.5), metal(0.9, 0.5)}) {
        Scene scene = stage();
        scene.camera.shutter_close = 1;
        add(scene, changed, material);
        check_furnace(scene);
      }
    });
  };
  try_shape(Sphere<>{{0, 0, 0}, 1, Vec3d{0.5, 0, 0}});
  try_shape(Quad<>{{-1, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  try_shape(Box<>{{-1, 0, -1}, {1, 1, 1}});
  const auto try_texture = [](const auto& texture) {
    drag_each(texture, [](const auto& changed) {
      Scene scene = stage();
      scene.textures = {{"t", changed}};
      scene.materials[0].colour = TextureIndex{0};
      check_both(scene);
    });
  };
  try_texture(Checker<>{});
  for (const auto style : {Noise<>::Style::perlin, Noise<>::Style::turbulence, Noise<>::Style::marble})
    try_texture(Noise<>{1, style});
  const auto try_sky = [](const auto& sky) {
    drag_each(sky, [](const auto& changed) {
      Scene scene = stage();
      scene.background = changed;
      check_stage(scene);
    });
  };
  try_sky(Gradient{});
  try_sky(Hemispheres{});
  try_sky(uniform_sky(4, 2, 0.02f));
  CHECK(pictures > 300);
}

}  // namespace tyndall::test::sliders_test

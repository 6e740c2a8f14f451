#include "core/transport/path.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <tuple>
#include <variant>

/// The path loop with a list of materials of the test's own, whose last one the program does not know: a material needs
/// its own header and a place in a list. Samples of this one are not all of the same weight.
namespace tyndall::test::longer_list_slow_test {

namespace {

/// A sheet that sends light into all directions of both sides, with the cosine. Its samples are uniform.
template <class F = double>
struct Opal {
  static constexpr const char* type = "opal";
  static constexpr const char* about = "Matt on both sides.";
  static constexpr const char* colour_name = nullptr;
  static constexpr BsdfTraits traits{.glossy = true, .transmissive = true, .light_sampling = LightSampling::weighted};
  F through = F(0.5);
  bool operator==(const Opal&) const = default;
};

constexpr double reflected = 0.3;  // share of the light; `through` is that of what passes

template <class F>
constexpr auto fields(const Opal<F>*) {
  return std::tuple{Field{"through", &Opal<F>::through, inside(0, 1), Slider{0, 1}, "", "share of what passes"}};
}
template <class F>
constexpr double lobe_width(const Opal<F>&) {
  return 1;
}
template <class F>
TYNDALL_INLINE F pdf(const Opal<F>&, const Incident<F>&, Vec3<F>) {
  return F(static_cast<float>(0.25 / pi));
}
template <class F>
TYNDALL_INLINE F eval(const Opal<F>& m, const Incident<F>& in, Vec3<F> direction) {
  const F cosine = dot(direction, in.facing);
  const F share = select(less(cosine, F(0.0f)), m.through, F(static_cast<float>(reflected)));
  return share * abs(cosine) * F(static_cast<float>(1 / pi));
}
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const Opal<F>& m, const Incident<F>& in) {
  const F density = pdf(m, in, in.unit_vector);
  return {in.unit_vector,
          eval(m, in, in.unit_vector) / density,
          density,
          {less(F(1.0f), F(0.0f)), less(dot(in.unit_vector, in.facing), F(0.0f))}};
}

/// The program's list, and opal.
template <class List>
struct WithOpal;
template <class F, template <class> class... Kinds>
struct WithOpal<std::variant<Kinds<F>...>> {
  using type = std::variant<Kinds<F>..., Opal<F>>;
};
template <class F>
using LongerList = typename WithOpal<MaterialKinds<F>>::type;

/// The program's scene as kernels see it, with the longer list.
struct LongerView : SceneView {
  template <class F>
  using MaterialList = LongerList<F>;
};

/// Mean radiance of a probe's rays, by the scalar kernel with the longer list. What is lambertian is opal.
Estimate kernel_radiance(const Scene& scene, double through, std::uint32_t samples) {
  RenderScene columns = compile(scene);
  for (std::size_t i = 0; i < columns.materials.kind.size(); ++i) {
    if (columns.materials.kind[i] != place_in<Lambertian<double>, LongerList<double>>) continue;
    columns.materials.kind[i] = place_in<Opal<double>, LongerList<double>>;
    columns.materials.parameter[0][i] = static_cast<float>(through);
  }
  const LongerView view{{columns}};
  std::vector<double> batches;
  for (std::uint32_t first = 0; first < samples; first += samples / 64) {
    FilmPixel pixel{};
    TileCounts counts;
    const TileJob job{{0, 0, 1, 1}, 1, 0, first, first + samples / 64};
    AloneSamples samples_of_unit(view, job, {1 / columns.film_quantum, &pixel, nullptr, counts});
    NoRecorder recorder;
    follow_paths<float>(view, samples_of_unit, counts, recorder);
    CHECK(pixel.rejected[0] + pixel.rejected[1] == 0);
    batches.push_back((pixel.sum[0][0].value() + pixel.sum[1][0].value()) * columns.film_quantum / (samples / 64));
  }
  return estimate(batches);
}

/// A large sheet, seen at an angle.
Scene sheet_in(Vec3d background) {
  Scene scene = white_room();
  scene.width = scene.height = 1;
  scene.background = background;
  add(scene, Quad<>{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, lambertian(1));
  aim(scene, {4, 0, 3}, {0, 0, 0});
  return scene;
}

}  // namespace

TEST_CASE("materials: what a trait decides follows the list") {
  using Longer = LongerList<double>;
  constexpr auto opal = place_in<Opal<double>, Longer>, glass = place_in<Dielectric<double>, Longer>;
  CHECK(has_trait<&BsdfTraits::transmissive, Longer>(opal));
  CHECK(has_trait<&BsdfTraits::transmissive, Longer>(glass));
  CHECK_FALSE(has_trait<&BsdfTraits::specular, Longer>(opal));
  CHECK_FALSE(has_trait<&BsdfTraits::transmissive>(opal));  // the program's list does not know it
  CHECK_FALSE(has_trait<&BsdfTraits::transmissive, Longer>(-1));
  CHECK(has_trait<&BsdfTraits::diffuse>(place_in<Lambertian<double>, Longer>));
  CHECK(has_trait<&BsdfTraits::emits>(place_in<Light<double>, Longer>));
  CHECK(has_constant_weights<SceneView>);
  CHECK_FALSE(has_constant_weights<LongerView>);
  CHECK(samples_lights_behind<LongerView>);
  CHECK_FALSE(samples_lights_behind<SceneView>);
}

TEST_CASE("path loop: in a white room a sheet of opal is as bright as its shares of light") {
  ZScores scores;
  for (const double through : {0.0, 0.2, 0.6})
    scores.add("sheet", kernel_radiance(sheet_in({1, 1, 1}), through, 1 << 16), reflected + through);
}

TEST_CASE("path loop: light that opal reflects and lets through, found by scattering and by shadow rays") {
  ZScores scores;
  for (const bool behind : {false, true})
    for (const Integrator integrator : {Integrator::path, Integrator::mis}) {
      Scene scene = sheet_in({0, 0, 0});
      scene.render.integrator = integrator;
      const Vec3d to_light = normalize(Vec3d{0.4, 0.3, behind ? -1.0 : 1.0});
      constexpr double distance = 20, radius = 6;
      add(scene, sphere(distance * to_light, radius), lamp(2));
      // The irradiance of a ball above the horizon is that of its middle: pi L (R/d)^2 cos.
      const double expected = 2 * std::pow(radius / distance, 2) * std::abs(to_light.z) * (behind ? 0.6 : reflected);
      scores.add("lamp", kernel_radiance(scene, 0.6, 1 << 16), expected, integrator == Integrator::mis ? 0.02 : 0.1);
    }
}

TEST_CASE("path loop: shadow rays into a ball of opal meet its far side, like the paths that go there") {
  Scene scene = white_room();
  scene.width = scene.height = 1;
  scene.background = Vec3d{0, 0, 0};
  add(scene, sphere({0, 0, 0}, 1), lambertian(1));
  add(scene, sphere({2, 0, -20}, 9), lamp(2));
  aim(scene, {3, 0, 5}, {0.2, 0, 0});
  const Estimate by_scattering = kernel_radiance(scene, 0.6, 1 << 20);
  scene.render.integrator = Integrator::mis;
  const Estimate with_shadow_rays = kernel_radiance(scene, 0.6, 1 << 18);
  CHECK(std::hypot(by_scattering.error, with_shadow_rays.error) < 0.02 * by_scattering.mean);
  check_agree(by_scattering, with_shadow_rays);
}

}  // namespace tyndall::test::longer_list_slow_test

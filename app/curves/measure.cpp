#include "app/curves/chart.h"

#include "core/accuracy/error.h"
#include "core/render/prepare.h"
#include "core/render/render.h"
#include "core/targets/kernels.h"

#include <optional>
#include <string_view>
#include <utility>

namespace tyndall {
namespace {

double squared(double x) { return x * x; }

/// A picture that is rendered further and further, each time from where it was left.
struct GrowingPicture {
  std::shared_ptr<const PreparedScene> scene;
  const ChartRun& run;
  RenderOptions options{};
  RenderResult result{};  ///< of the last step
  double seconds = 0;     ///< of all steps

  /// Renders on until each pixel has `spp` samples; false if it was stopped on the way.
  bool grow(std::uint32_t spp) {
    options.threads = run.threads, options.adaptive = scene->scene().render.adaptive, options.spp = spp;
    const auto progress = [this](const RenderProgress& now) { return run.go_on(seconds + now.seconds); };
    result = render(*scene, options, progress, std::move(result.film));
    seconds += result.seconds;
    return !result.interrupted;
  }
};

}  // namespace

ChartReference render_reference(Scene scene, double seconds, const ChartRun& run) {
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::random;
  scene.render.fresnel = FresnelKind::exact;
  scene.render.adaptive = false;
  scene.render.seed += 0x5eed;
  GrowingPicture picture{prepare(scene), run};
  for (std::uint32_t spp = 2; picture.grow(spp) && spp < (1u << 22) && 2 * picture.seconds < seconds * 1.4;) spp *= 2;
  FinishedPicture reference = finished_picture(*picture.scene, picture.result);
  const std::uint32_t taken = reference.totals.min_taken;
  if (taken < 2) return {};
  return {std::move(reference.image), squared(reference.estimate.relative_error),
          "mis, random numbers of another seed, " + std::to_string(taken) + " spp"};
}

ErrorCurve measure_curve(Scene scene, const ChartMethod& method, const ChartReference& reference, double seconds,
                         const ChartRun& run) {
  scene.render = method.settings;
  GrowingPicture picture{method.splits ? prepare(scene) : prepare_without_splitting(scene), run};
  picture.options.isa = method.isa, picture.options.clean = method.clean;
  ErrorCurve curve{method.name, {}};
  for (std::uint32_t spp = 1; spp < (1u << 22) && picture.grow(spp); spp *= 2) {
    const std::optional<CleanPicture>& clean = picture.result.clean;
    if (method.clean && !clean) continue;
    const FinishedPicture now = finished_picture(*picture.scene, picture.result);
    const double measured = relative_mse(clean ? clean->rgb : now.image.rgb, reference.image.rgb);
    curve.points.push_back({picture.seconds + picture.result.seconds_clean, measured - reference.noise, spp,
                            squared(clean ? clean->relative_error : now.estimate.relative_error)});
    if (measured < min_measurable(reference.noise) || 2 * picture.seconds > seconds * 1.4) break;
  }
  return curve;
}

std::vector<ChartMethod> default_methods(const Scene& scene) {
  Scene exact = scene;  // compiled with everything on, to see which methods make a difference
  exact.render.integrator = Integrator::mis;
  exact.render.fresnel = FresnelKind::exact;
  exact.render.caustics = Caustics::chains;
  exact.render.sharing = true;
  const std::shared_ptr<const PreparedScene> prepared = prepare(exact);
  const SceneFeatures& features = prepared->columns().features;
  const bool glass = has_material<Dielectric<>>(features);
  RenderSettings settings = scene.render;
  settings.spp.reset();
  settings.adaptive = false;
  settings.integrator = Integrator::path;
  settings.sampler = SamplerKind::random;
  settings.caustics = Caustics::scatter;
  settings.sharing = false;
  settings.fresnel = glass ? FresnelKind::schlick : FresnelKind::exact;
  bool splits = false;
  std::vector<ChartMethod> methods;
  const auto add = [&](const std::string& name, const char* isa = "scalar", bool clean = false) {
    methods.push_back({name, settings, isa, clean, splits});
  };
  add("the books' method");
  if (glass) settings.fresnel = FresnelKind::exact, add("+ exact Fresnel");
  if (has_material<Light<>>(features)) {
    settings.integrator = Integrator::nee, add("+ light sampling");
    settings.integrator = Integrator::mis, add("+ MIS");
  }
  settings.sampler = SamplerKind::sobol, add("+ Sobol'");
  const bool specular_paths = !prepared->columns().specular.sphere.empty(), guided = prepared->guide().lobes() > 0;
  if (specular_paths || guided) {
    settings.caustics = Caustics::chains;
    add(!guided ? "+ chains" : specular_paths ? "+ chains, guided light" : "+ guided light");
  }
  splits = true;
  if (prepared->columns().splits_paths) settings.caustics = Caustics::chains, add("+ splitting");
  if (prepared->reuses_paths()) settings.sharing = true, add("+ sharing");
  for (const Kernels& kernels : available_kernels())
    if (std::string_view(kernels.isa) != "scalar") add(std::string("+ ") + kernels.isa, kernels.isa);
  add("+ clean (filtered)", "", true);
  settings.adaptive = true, add("+ adaptive", "");
  settings.adaptive = false;
  if (glass) settings.fresnel = FresnelKind::schlick, add("Schlick", "");
  return methods;
}

}  // namespace tyndall

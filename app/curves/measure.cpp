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
class GrowingPicture {
 public:
  GrowingPicture(std::shared_ptr<const PreparedScene> scene, const std::string& isa, bool clean, const ChartRun& run)
      : scene_(std::move(scene)), run_(run) {
    options_.isa = isa;
    options_.clean = clean;
    options_.threads = run.threads;
    options_.adaptive = scene_->scene().render.adaptive;
  }
  /// Renders on until each pixel has `spp` samples; false if it was stopped on the way.
  bool grow(std::uint32_t spp) {
    options_.spp = spp;
    const auto progress = [this](const RenderProgress& now) { return run_.go_on(seconds_ + now.seconds); };
    result_ = render(*scene_, options_, progress, std::move(result_.film));
    seconds_ += result_.seconds;
    return !result_.interrupted;
  }
  double seconds() const { return seconds_; }
  FinishedPicture finished() const { return finished_picture(*scene_, result_); }
  /// The error of the picture as it is or, if that was asked for, of its clean view; nothing where there is none.
  std::optional<ErrorPoint> point(std::uint32_t spp, const ChartReference& reference) const {
    const auto at = [&](double seconds, const std::vector<float>& rgb, double relative_error) {
      return ErrorPoint{seconds, relative_mse(rgb, reference.image.rgb) - reference.noise, spp,
                        squared(relative_error)};
    };
    if (options_.clean && !result_.clean) return {};
    if (options_.clean) return at(seconds_ + result_.seconds_clean, result_.clean->rgb, result_.clean->relative_error);
    const FinishedPicture now = finished();
    return at(seconds_, now.image.rgb, now.estimate.relative_error);
  }

 private:
  std::shared_ptr<const PreparedScene> scene_;
  const ChartRun& run_;
  RenderOptions options_{};
  RenderResult result_{};  ///< of the last step
  double seconds_ = 0;     ///< of all steps
};

}  // namespace

ChartReference render_reference(Scene scene, double seconds, const ChartRun& run) {
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::random;
  scene.render.fresnel = FresnelKind::exact;
  scene.render.adaptive = false;
  scene.render.seed += 0x5eed;
  GrowingPicture picture(prepare(scene), "", false, run);
  std::uint32_t spp = 2;
  while (picture.grow(spp) && spp < (1u << 22) && 2 * picture.seconds() < seconds * 1.4) spp *= 2;
  FinishedPicture reference = picture.finished();
  const std::uint32_t taken = reference.totals.min_taken;
  if (taken < 2) return {};
  return {std::move(reference.image), squared(reference.estimate.relative_error),
          "mis, random numbers of another seed, " + std::to_string(taken) + " spp"};
}

ErrorCurve measure_curve(Scene scene, const ChartMethod& method, const ChartReference& reference, double seconds,
                         const ChartRun& run) {
  scene.render = method.settings;
  GrowingPicture picture(method.splits ? prepare(scene) : prepare_without_splitting(scene), method.isa, method.clean,
                         run);
  ErrorCurve curve{method.name, {}};
  for (std::uint32_t spp = 1; spp < (1u << 22) && picture.grow(spp); spp *= 2) {
    const auto point = picture.point(spp, reference);
    if (!point) continue;
    curve.points.push_back(*point);
    const double measured = point->rel_mse + reference.noise;
    if (measured < min_measurable(reference.noise) || 2 * picture.seconds() > seconds * 1.4) break;
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
  const SceneFeatures features = prepared->columns().features;
  std::vector<ChartMethod> methods;
  RenderSettings settings = scene.render;
  settings.spp.reset();
  settings.adaptive = false;
  settings.integrator = Integrator::path;
  settings.sampler = SamplerKind::random;
  settings.caustics = Caustics::scatter;
  settings.sharing = false;
  settings.fresnel = has_material<Dielectric<>>(features) ? FresnelKind::schlick : FresnelKind::exact;
  methods.push_back({"the books' method", settings, "scalar"});
  bool splits = false;
  const auto switch_on = [&](const char* name, auto setting, auto value) {
    settings.*setting = value;
    methods.push_back({name, settings, "scalar", false, splits});
  };
  using Settings = RenderSettings;
  if (has_material<Dielectric<>>(features)) switch_on("+ exact Fresnel", &Settings::fresnel, FresnelKind::exact);
  if (has_material<Light<>>(features)) {
    switch_on("+ light sampling", &Settings::integrator, Integrator::nee);
    switch_on("+ MIS", &Settings::integrator, Integrator::mis);
  }
  switch_on("+ Sobol'", &Settings::sampler, SamplerKind::sobol);
  const bool specular_paths = !prepared->columns().specular.sphere.empty(), guided = prepared->guide().lobes() > 0;
  const char* paths = !guided ? "+ chains" : specular_paths ? "+ chains, guided light" : "+ guided light";
  if (specular_paths || guided) switch_on(paths, &Settings::caustics, Caustics::chains);
  splits = true;
  if (prepared->columns().splits_paths) switch_on("+ splitting", &Settings::caustics, Caustics::chains);
  if (prepared->reuses_paths()) switch_on("+ sharing", &Settings::sharing, true);
  for (const Kernels& kernels : available_kernels())
    if (std::string_view(kernels.isa) != "scalar")
      methods.push_back({std::string("+ ") + kernels.isa, settings, kernels.isa});
  methods.push_back({"+ clean (filtered)", settings, "", true});
  settings.adaptive = true;
  methods.push_back({"+ adaptive", settings, ""});
  settings.adaptive = false;
  if (has_material<Dielectric<>>(features)) {
    settings.fresnel = FresnelKind::schlick;
    methods.push_back({"Schlick", settings, ""});
  }
  return methods;
}

}  // namespace tyndall

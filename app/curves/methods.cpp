#include "app/curves/measure.h"
#include "core/render/prepare.h"
#include "core/targets/kernels.h"

#include <string_view>

namespace tyndall {

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
  const auto switch_on = [&](const char* name, auto change) {
    change(settings);
    methods.push_back({name, settings, "scalar"});
  };
  if (has_material<Dielectric<>>(features))
    switch_on("+ exact Fresnel", [](RenderSettings& s) { s.fresnel = FresnelKind::exact; });
  if (has_material<Light<>>(features)) {
    switch_on("+ light sampling", [](RenderSettings& s) { s.integrator = Integrator::nee; });
    switch_on("+ MIS", [](RenderSettings& s) { s.integrator = Integrator::mis; });
  }
  switch_on("+ Sobol'", [](RenderSettings& s) { s.sampler = SamplerKind::sobol; });
  if (!prepared->columns().specular.sphere.empty())
    switch_on("+ chains", [](RenderSettings& s) { s.caustics = Caustics::chains; });
  if (prepared->reuses_paths()) switch_on("+ sharing", [](RenderSettings& s) { s.sharing = true; });
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

#include "app/report/gain.h"

#include "core/accuracy/estimate.h"
#include "core/render/render.h"

#include <algorithm>
#include <vector>

namespace tyndall {
namespace {

constexpr int pairs = 9, rounds = 5;
constexpr double seconds_of_pair = 0.1, seconds_of_round = 0.2;  // that each render of one takes, about
constexpr int widest = 160;                                      // most pixels in a row of the small picture

RenderResult timed(const PreparedScene& scene, const std::string& isa, std::uint32_t spp) {
  RenderOptions options;
  options.threads = 1;
  options.isa = isa;
  options.spp = spp;
  return render(scene, options);
}

/// How many samples a pixel, `spp` or more, take about `seconds` to render.
std::uint32_t enough_samples(const PreparedScene& scene, const std::string& isa, std::uint32_t spp, double seconds) {
  while (spp < 4096 && timed(scene, isa, spp).seconds < seconds / 2) spp *= 2;
  return spp;
}

double squared_error(const RenderResult& result) {
  const double error = estimate_error(result.film).relative_error;
  return error * error;
}

void make_small(Scene& scene) {
  if (scene.width <= widest) return;
  scene.height = std::max(scene.height * widest / scene.width, 1);
  scene.width = widest;
}

MethodGain measure(const PreparedScene& with, const PreparedScene& without, const std::string& isa) {
  const std::uint32_t spp = enough_samples(with, isa, 4, seconds_of_round);
  double times[rounds], with_error = 0, without_error = 0;
  for (double& time : times) {
    const RenderResult own = timed(with, isa, spp), other = timed(without, isa, spp);
    time = own.seconds / other.seconds;
    with_error = squared_error(own), without_error = squared_error(other);
  }
  std::sort(times, times + rounds);
  const double time = times[rounds / 2];
  return {true, time, without_error > 0 ? time * with_error / without_error : 1};
}

}  // namespace

KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels) {
  const std::string isa = kernels.isa;
  KernelGain result;
  result.isa = isa;
  if (kernels.set_for(scene.view()) == KernelSet::everything) return result;
  RenderScene columns = scene.columns();
  columns.kernel = KernelSet::everything;
  const PreparedScene full(std::make_shared<const Scene>(scene.scene()), columns);
  const std::uint32_t spp = enough_samples(scene, isa, 1, seconds_of_pair);
  std::vector<double> gains;
  for (result.pairs = 0; result.pairs < pairs; ++result.pairs) {
    const bool own_first = result.pairs % 2 == 0;
    const RenderResult first = timed(own_first ? scene : full, isa, spp);
    const RenderResult second = timed(own_first ? full : scene, isa, spp);
    gains.push_back(own_first ? second.seconds / first.seconds : first.seconds / second.seconds);
    result.same_picture &= resolve(first.film) == resolve(second.film);
  }
  std::sort(gains.begin(), gains.end());
  result.gain = gains[pairs / 2];
  result.minimum = gains.front(), result.maximum = gains.back();
  return result;
}

MethodGain measure_method_gain(MisMethod method, Scene scene, const std::string& isa) {
  make_small(scene);
  const auto with = prepare(scene);
  const bool specular = !with->columns().specular.sphere.empty() || with->guide().lobes() > 0;
  switch (method) {
    case MisMethod::specular:
      scene.render.caustics = Caustics::scatter;
      return specular ? measure(*with, *prepare(scene), isa) : MethodGain{};
    case MisMethod::splitting:
      return with->columns().splits_paths ? measure(*with, *prepare_without_splitting(scene), isa) : MethodGain{};
    case MisMethod::sharing:
      scene.render.sharing = false;
      return with->reuses_paths() ? measure(*with, *prepare(scene), isa) : MethodGain{};
  }
  return {};
}

}  // namespace tyndall

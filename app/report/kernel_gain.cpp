#include "app/report/kernel_gain.h"

#include "core/render/render.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tyndall {
namespace {

constexpr int pairs = 9;
constexpr double seconds_each = 0.1;

RenderResult timed(const PreparedScene& scene, const std::string& isa, std::uint32_t spp) {
  RenderOptions options;
  options.threads = 1;
  options.isa = isa;
  options.spp = spp;
  return render(scene, options);
}

/// How many samples a pixel take about `seconds_each` to render.
std::uint32_t enough_samples(const PreparedScene& scene, const std::string& isa) {
  std::uint32_t spp = 1;
  while (spp < 4096 && timed(scene, isa, spp).seconds < seconds_each / 2) spp *= 2;
  return spp;
}

}  // namespace

KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels) {
  const std::string isa = kernels.isa;
  KernelGain result;
  result.isa = isa;
  if (kernels.set_for(scene.columns().kernel) == KernelSet::everything) return result;
  RenderScene columns = scene.columns();
  columns.kernel = KernelSet::everything;
  const PreparedScene full(std::make_shared<const Scene>(scene.scene()), std::move(columns));
  const std::uint32_t spp = enough_samples(scene, isa);
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
  result.least = gains.front(), result.most = gains.back();
  return result;
}

}  // namespace tyndall

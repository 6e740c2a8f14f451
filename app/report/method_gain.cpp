#include "app/report/method_gain.h"

#include "core/accuracy/estimate.h"
#include "core/render/render.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr int widest = 160;  // most pixels in a row of the small picture
constexpr int rounds = 5;
constexpr double seconds_a_render = 0.2;

RenderResult render_once(const PreparedScene& scene, const std::string& isa, std::uint32_t spp) {
  RenderOptions options;
  options.threads = 1;
  options.isa = isa;
  options.spp = spp;
  return render(scene, options);
}

double squared_error(const RenderResult& result) {
  const double error = estimated_relative_error(result.film);
  return error * error;
}

void make_small(Scene& scene) {
  if (scene.width <= widest) return;
  scene.height = std::max(scene.height * widest / scene.width, 1);
  scene.width = widest;
}

MethodGain measure(const PreparedScene& with, const PreparedScene& without, const std::string& isa) {
  std::uint32_t spp = 4;
  while (spp < 4096 && render_once(with, isa, spp).seconds < seconds_a_render / 2) spp *= 2;
  double times[rounds], with_error = 0, without_error = 0;
  for (double& time : times) {
    const RenderResult own = render_once(with, isa, spp), other = render_once(without, isa, spp);
    time = own.seconds / other.seconds;
    with_error = squared_error(own), without_error = squared_error(other);
  }
  std::sort(times, times + rounds);
  const double time = times[rounds / 2];
  return {true, time, without_error > 0 ? time * with_error / without_error : 1};
}

}  // namespace

MethodGain measure_chain_gain(Scene scene, const std::string& isa) {
  make_small(scene);
  const auto with = prepare(scene);
  if (with->columns().chains.ball.empty()) return {};
  scene.render.caustics = Caustics::scatter;
  return measure(*with, *prepare(scene), isa);
}

MethodGain measure_sharing_gain(Scene scene, const std::string& isa) {
  make_small(scene);
  const auto with = prepare(scene);
  if (!with->reuses_paths()) return {};
  scene.render.sharing = false;
  return measure(*with, *prepare(scene), isa);
}

}  // namespace tyndall

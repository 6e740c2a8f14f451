#include "tests/bench/references.h"

#include "core/accuracy/estimate.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/fingerprint.h"
#include "tests/support/prepared.h"

#include <cmath>
#include <fstream>

namespace tyndall::bench {

using namespace test;
namespace {

constexpr std::uint32_t reference_seed = 2718281828;

}  // namespace

Reference reference_image(const NamedScene& named, int spp, const std::filesystem::path& folder) {
  Scene scene = named.scene;
  scene.render.seed = reference_seed;
  scene.render.spp = spp;
  const std::string version = test::fingerprint(write_scene(scene));
  const auto file = folder / ("reference-" + named.name + "-" + std::to_string(spp) + "-" + version + ".pfm");
  auto noise = file;
  noise.replace_extension(".txt");
  double rel_mse = 0;
  if (std::ifstream(noise) >> rel_mse) return {read_image(file).rgb, rel_mse};
  const RenderScene compiled = compile(scene);
  const Film film = render(compiled, {.spp = static_cast<std::uint32_t>(spp)}).film;
  const LinearImage image{compiled.width, compiled.height, resolve(film)};
  rel_mse = std::pow(estimate_error(film).relative_error, 2);
  write_pfm(file, image);
  std::ofstream(noise) << rel_mse << "\n";
  return {image.rgb, rel_mse};
}

}  // namespace tyndall::bench

#include "tests/support/references.h"

#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/fingerprint.h"
#include "tests/support/paths.h"
#include "tests/support/prepared.h"

namespace tyndall::test {
namespace {

constexpr std::uint32_t reference_seed = 2718281828;

}  // namespace

Reference reference_of(Scene scene, std::uint32_t spp) {
  scene.render.seed = reference_seed;
  scene.render.spp = static_cast<int>(spp);
  scene.render.adaptive = false;
  const std::filesystem::path folder = references_folder();
  std::filesystem::create_directories(folder);
  const std::string name = "halves-" + fingerprint(write_scene(scene));
  const std::filesystem::path files[2] = {folder / (name + "-a.pfm"), folder / (name + "-b.pfm")};
  Reference reference;
  if (std::filesystem::exists(files[0]) && std::filesystem::exists(files[1])) {
    for (int half = 0; half < 2; ++half) reference.half[half] = read_image(files[half]).rgb;
    return reference;
  }
  const Film film = render(compile(scene), {.spp = spp}).film;
  for (int half = 0; half < 2; ++half) {
    for (const FilmPixel& pixel : film.pixels) {
      const Vec3f value = half_mean(film, pixel, half);
      reference.half[half].insert(reference.half[half].end(), {value.x, value.y, value.z});
    }
    write_pfm(files[half], {scene.width, scene.height, reference.half[half]});
  }
  return reference;
}

}  // namespace tyndall::test

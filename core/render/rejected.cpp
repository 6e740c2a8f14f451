#include "core/render/rejected.h"

namespace tyndall {

std::vector<RejectedSample> find_rejected(const Kernels& kernels, const SceneView& scene, const Film& film,
                                          std::size_t most) {
  std::vector<RejectedSample> found;
  for (int y = film.region.y0; y < film.region.y1; ++y)
    for (int x = film.region.x0; x < film.region.x1; ++x) {
      const FilmPixel& pixel = film.at(x, y);
      std::uint32_t left = pixel.rejected[0] + pixel.rejected[1];
      for (std::uint32_t i = 0; left > 0 && i < pixel.taken; ++i) {
        if (found.size() >= most) return found;
        FilmPixel again{};
        UnitCounts counts;
        const std::uint32_t sample = film.first_sample + i;
        kernels.render_unit(scene, {{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1}, film.unit, &again, counts);
        if (again.rejected[sample & 1u] == 0) continue;
        found.push_back({x, y, sample});
        --left;
      }
    }
  return found;
}

}  // namespace tyndall

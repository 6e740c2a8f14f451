#include "app/files/layers.h"

#include <algorithm>
#include <limits>

namespace tyndall {
namespace {

Layer variance_layer(const Film& film) {
  Layer layer{"Variance", {"R", "G", "B"}, {}};
  layer.values.reserve(3 * film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) {
    const bool whole = counted(film, pixel, 0) > 0 && counted(film, pixel, 1) > 0;
    const Vec3f half = 0.5f * (half_mean(film, pixel, 0) - half_mean(film, pixel, 1));
    for (const float v : {half.x, half.y, half.z})
      layer.values.push_back(whole ? v * v : std::numeric_limits<float>::infinity());
  }
  return layer;
}

}  // namespace

std::vector<Layer> layers_of(const PreparedScene& scene, const Film& film, const Kernels& kernels) {
  const Region& region = film.region;
  constexpr int rows = 64;  // at a time, to spare memory
  std::vector<Layer> layers = {
      {"Albedo", {"R", "G", "B"}, {}, true}, {"Ns", {"X", "Y", "Z"}, {}}, {"Depth", {"Z"}, {}}};
  for (Layer& layer : layers) layer.values.reserve(layer.channels.size() * film.pixels.size());
  std::vector<float>&albedo = layers[0].values, &normal = layers[1].values, &depth = layers[2].values;
  for (int y = region.y0; y < region.y1; y += rows) {
    const Region strip{region.x0, y, region.x1, std::min(y + rows, region.y1)};
    std::vector<FirstHit> hits(static_cast<std::size_t>(strip.width()) * static_cast<std::size_t>(strip.height()));
    kernels.first_hits(scene.view(), strip, hits.data());
    for (const FirstHit& hit : hits) {
      albedo.insert(albedo.end(), {hit.albedo.x, hit.albedo.y, hit.albedo.z});
      normal.insert(normal.end(), {hit.normal.x, hit.normal.y, hit.normal.z});
      depth.push_back(hit.element < 0 ? std::numeric_limits<float>::infinity() : hit.depth);
    }
  }
  layers.push_back(variance_layer(film));
  return layers;
}

}  // namespace tyndall

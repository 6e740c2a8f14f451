#pragma once
#include "app/text/values.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Which scene the user wants, and what options change in it.
namespace tyndall {

/// A scene, and what options change in it.
struct SceneRequest {
  std::string what = "showroom";  ///< file, built-in name, image, or "-": standard input
  std::vector<Override> overrides;
  std::optional<Size> size;
  std::optional<int> max_depth;
  std::optional<Integrator> integrator;
  std::optional<SamplerKind> sampler;
  std::optional<FresnelKind> fresnel;
  std::optional<double> exposure;
  std::optional<ToneMap> tone_map;
  std::optional<std::uint32_t> seed;
  bool adaptive = false;  ///< switched on; else the scene says
};

}  // namespace tyndall

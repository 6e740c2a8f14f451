#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"
#include "core/targets/replay.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// What happened along one path of light, told in words; and why a pixel is noisy: which of its samples brings most
/// light, and by which way.
namespace tyndall {

/// `"ball" (glass)`: what an object is called, or else its place in the file, and its material. path: of indices, as in
/// Elements::object.
std::string object_text(const Scene& scene, const std::vector<int>& path);

/// The paths of all media with a density, in the order of RenderScene::media.
std::vector<std::vector<int>> media_of(const Scene& scene);

/// One path as text, a paragraph a vertex: what it met (by its name in the scene, else by its place in the file) and
/// what became of it there; which part of the light gathered there came by exact chains, and what a light counts that
/// chance found but chains find too. Positions are the scene's own. The last line is the sample's value, to the last
/// bit.
std::string replay_text(const Scene& scene, const RenderScene& compiled, const PathReplay& path);

/// The brightest of a pixel's samples.
struct NoisyPath {
  int x = 0, y = 0;
  std::uint32_t samples = 0;  ///< so many of the pixel's samples were followed, from the first on
  std::uint32_t sample = 0;   ///< number of the brightest
  double fraction = 0;        ///< of the light (luminance) of all that were followed
  double times_mean = 0;      ///< its light over the mean
  PathReplay path{};
};

/// Follows the first `samples` samples of a pixel, and fewer if stop() says so after one of them; at least one.
NoisyPath find_noisy_path(const SceneView& scene, int x, int y, std::uint32_t samples,
                          const std::function<bool()>& stop);

/// A place on a path, to be drawn and told in a line.
struct PathStop {
  Vec3d point;         ///< where; the scene's own coordinates
  int before = -1;     ///< index of the stop from which the path, or a branch of it, came; -1: the camera
  bool away = false;   ///< the path meets nothing any more: `point` is a unit direction
  std::string text;    ///< "ball (gold): goes on, x 0.9 0.6 0.3"
  bool light = false;  ///< light was gathered here
};

/// The stops of a path after the camera. scene and compiled are the same scene.
std::vector<PathStop> stops_of(const Scene& scene, const RenderScene& compiled, const PathReplay& path);

/// "the brightest of 256 samples: 38 % of their light, 97 times the mean".
std::string sentence_of(const NoisyPath& found);

}  // namespace tyndall

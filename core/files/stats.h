#pragma once
#include "core/image/image_io.h"
#include "core/render/prepare.h"
#include "core/render/render.h"
#include "core/targets/kernels.h"

#include <cstdint>
#include <string>
#include <vector>

/// The figures of a run, for --stats and for the files that a render writes.
namespace tyndall {

/// What --stats says about a run, and what made it.
struct RunFigures {
  std::string scene;  ///< file or built-in name
  const PreparedScene& prepared;
  const RenderResult& result;
  const FinishedPicture& picture;    ///< of that result
  std::uint64_t samples_before = 0;  ///< in the film when the run began
  double seconds_build = 0;          ///< preparing the scene
  double seconds_total = 0;          ///< from the command's start to now
  std::string threads_from{};        ///< what decided the number of threads: see ThreadCount
};

/// All figures, as a JSON object. What is not known is null.
std::string stats_text(const RunFigures& run);

/// What PNG and EXR carry beside the scene: the figures that are the same for every run of the same build.
std::string embedded_stats_text(const RunFigures& run);

/// The same for a film that was read from a file and filtered: what is known of it.
std::string clean_stats_text(const Film& film, const CleanPicture& clean, double seconds);

/// The layers that an EXR gets beside a picture. Of what is seen first through the middle of each pixel: albedo, normal
/// (towards the outside of the shape), and depth along the camera's axis; 0, 0 and infinity where nothing is seen. From
/// the film's halves: the variance of each pixel's mean, by channel; infinite if a half has no sample.
std::vector<Layer> layers_of(const PreparedScene& scene, const Film& film, const Kernels& kernels);

}  // namespace tyndall

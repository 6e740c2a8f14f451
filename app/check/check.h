#pragma once
#include "app/check/explain.h"
#include "app/comparison/comparison.h"
#include "app/files/open_scene.h"

#include <filesystem>
#include <functional>
#include <string>

namespace tyndall {

/// Whether a name stands for a scene to compare with, and not for a picture: a built-in scene, a C++ source file, or a
/// file that is no picture. PNG and EXR are pictures, also those that carry a scene.
bool names_scene(const std::string& name);

/// Throws UsageError for a name that is not a scene's and cannot be a picture's: of nothing, or of a folder. A file
/// that is called like a picture and is not there is left to those who read it.
void check_names_picture(const std::string& name);

struct CheckRequest {
  std::filesystem::path image;
  PpmCurve ppm = PpmCurve::srgb;  ///< how the numbers of a PPM are read for `comparison`
  SceneRequest scene;
  CheckOptions options;
  /// Told what is being done, and asked whether to go on; empty: nobody is.
  std::function<bool(const std::string& stage, double seconds)> progress;
};

/// Compares a small picture of the scene that was taken from a program, made by the rules of its edition, with one of
/// samples that the program computes itself. Returns why they are not the same, in one sentence; "": they are, or it
/// cannot be judged (of noise and images, each program has its own). Takes half a second of the program's time.
std::string differs_from_own(const Scene& scene, const ProgramScene& program);

/// A picture against a scene.
struct Check {
  Comparison comparison;  ///< with the scene, rendered in the picture's size
  Findings verdict;
};

/// Renders the scene in the picture's size, and compares. Throws as open_scene(), read_whole_picture() and
/// compare_pair() do.
Check check_picture(const CheckRequest& request);

}  // namespace tyndall

#pragma once
#include "app/cli/requests.h"

/// What each approximation costs: how far it moves a picture, apart from noise.
namespace tyndall {

/// A relative root mean square difference (as sqrt of relMSE) between two ways to render, and its standard error.
struct Shift {
  double rms = 0, error = 0;
};

/// Shifts of one scene from the exact picture: exact Fresnel terms, paths of up to 1000 events, linear floats.
struct Accuracy {
  Shift schlick;                   ///< the books' Fresnel rule
  Shift depth5, depth10, depth50;  ///< max_depth
  Shift single;                    ///< lanes of float instead of double, on the same compiled scene
  Shift bytes;                     ///< 8-bit sRGB instead of floats, in channels within [0, 1]
  Shift clean;                     ///< the clean view of 16 samples a pixel, without the noise that it leaves
};

/// Renders the scene small, each way with the same random numbers: where both ways take the same path, noise cancels.
/// The noise that is left differs between the two halves, so it averages to 0 in the product of their differences.
Accuracy measure_accuracy(Scene scene);

/// Prints a table, a line a scene: of the requested scene, or of all built-in ones if it names none. Returns the exit
/// code.
int print_accuracy(const SceneRequest& request);

}  // namespace tyndall

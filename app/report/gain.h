#pragma once
#include "core/film/film.h"
#include "core/render/prepare.h"
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <limits>
#include <string>

/// What is gained in a scene by a kernel that leaves out the models which it does not use, and by methods of integrator
/// mis; and how far two pictures of one sweep are apart, and how much of that is noise.
namespace tyndall {

/// What a scene's own kernel gains over the one that holds every model.
struct KernelGain {
  std::string isa;
  double gain = 1;                  ///< speed over the full kernel's: median of the pairs
  double minimum = 1, maximum = 1;  ///< of the pairs
  int pairs = 0;                    ///< 0: the full kernel is the scene's own, nothing was measured
  bool same_picture = true;         ///< to the last bit
};

/// Renders the scene by both in turns, on one thread, for about two seconds. Where `kernels` render the scene with the
/// full kernel, nothing is rendered and the gain is 1.
KernelGain measure_kernel_gain(const PreparedScene& scene, const Kernels& kernels);

/// What a method of integrator mis costs and gains in a scene, against doing without it.
struct MethodGain {
  bool measured = false;  ///< false: the scene does without it anyway
  double time = 1;        ///< time of a sample over that without the method; median over pairs of renders
  double error = 1;       ///< estimated squared error at equal time over that without the method
};

/// Exact chains, against leaving their light to chance; both ways at smooth glass that the camera sees
/// (core/transport/splitting.h); sharing of second vertices between pixels.
enum class MisMethod { specular, splitting, sharing };
/// Renders the scene with and without the method in turns, as a small picture on one thread, for about two seconds.
/// Where chance seldom finds the light, the error without chains is estimated too small, and the true gain is larger.
MethodGain measure_method_gain(MisMethod method, Scene scene, const std::string& isa);

/// Each with an error found from the two halves of the difference itself. Pictures of one seed have most of their noise
/// in common: the errors of both pictures taken together would be several times too large.
struct FilmDifference {
  double mean = 0;                                              ///< of the pixels and channels of film - reference
  double mean_error = std::numeric_limits<double>::infinity();  ///< standard error of `mean`
  double rms = 0;  ///< root mean square over pixels and channels, freed of noise
  double rms_error = std::numeric_limits<double>::infinity();  ///< root mean square error of a pixel's difference
};

/// Both films have one region. The errors are infinite while a half of a pixel is empty.
///
/// With the halves a and b of the difference d, ((a - b) / 2)² estimates the variance of d and a b its true square,
/// both without bias.
FilmDifference film_difference(const Film& film, const Film& reference);

}  // namespace tyndall

#pragma once
#include "app/curves/curve.h"
#include "core/image/image_io.h"
#include "core/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

/// Renders a scene in different ways and measures the error of each over time, for the command `chart`.
namespace tyndall {

/// A way of rendering, to be compared with others.
struct ChartMethod {
  std::string name;
  RenderSettings settings;
  std::string isa;     ///< "": the best
  bool clean = false;  ///< the filtered picture; its time includes the filter
  bool splits = true;  ///< both ways at glass may be followed (core/transport/splitting.h)
};

/// The methods that `chart` compares by default: first that of the books, then each improvement switched on in addition
/// to those before it, then each approximation by itself. Those that make no difference to the scene are left out, for
/// example Fresnel's equations in a scene without glass.
std::vector<ChartMethod> default_methods(const Scene& scene);

/// The picture that errors are measured against.
struct ChartReference {
  LinearImage image;
  double noise = 0;   ///< its own relMSE, which measured errors contain; 0: not known, a floor may be just that
  std::string about;  ///< "nee, random, 512 spp"
};

struct ChartRun {
  int threads = 0;                              ///< 0: see thread_count()
  std::function<bool(double seconds)> go_on{};  ///< asked often, with the seconds of rendering so far; false: stop
};

/// Renders a reference for about `seconds`: mis, random numbers of another seed, nothing approximate. Its image is
/// empty if it was stopped before every pixel had two samples.
ChartReference render_reference(Scene scene, double seconds, const ChartRun& run);

/// Renders by a method for about `seconds`, or until the reference's noise would show, and measures the error at each
/// power of two of samples a pixel.
ErrorCurve measure_curve(Scene scene, const ChartMethod& method, const ChartReference& reference, double seconds,
                         const ChartRun& run);

}  // namespace tyndall

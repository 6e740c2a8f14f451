#pragma once
#include "core/image/image_io.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Speed against accuracy: the error of a growing picture over the seconds it took.
namespace tyndall {

/// A way of rendering, to be compared with others.
struct ChartMethod {
  std::string name;
  RenderSettings settings;
  std::string isa;  ///< "": the best
};

/// The books' method, and each improvement switched on in turn, as far as the scene has a use for it; then what is
/// approximate, alone.
std::vector<ChartMethod> default_methods(const Scene& scene);

/// What curves are measured against.
struct ChartReference {
  LinearImage image;
  double rel_mse = 0;  ///< the part of measured errors that is its own noise; 0: not known, floors may be that
  std::string about;   ///< "nee, random, 512 spp"
};

struct ChartPoint {
  std::uint32_t spp = 0;
  double seconds = 0;  ///< of rendering
  double rel_mse = 0;  ///< against the reference, the reference's own noise taken off
  double noise = 0;    ///< the part of it that is noise, as the picture's halves tell; infinite at 1 spp
};

struct ChartCurve {
  std::string method;
  std::vector<ChartPoint> points;  ///< spp grows
};

/// Error below which the reference's own noise would show.
double least_measurable(const ChartReference& reference);

/// Seconds at which the curve crosses an error, between its points on logarithmic scales; nothing if it does not.
std::optional<double> seconds_to(const ChartCurve& curve, double rel_mse);

/// How many times less time a curve takes than the first one to the least error that both reach; nothing if there is
/// none. The answer depends on the error: Sobol' points gain on random numbers the lower it is.
std::optional<double> speed_against(const ChartCurve& first, const ChartCurve& curve);

/// The error that does not go away when the samples double, from the last points: what the noise does not explain.
/// Nothing where it cannot be told from noise.
std::optional<double> bias_of(const ChartCurve& curve, const ChartReference& reference);

struct ChartRun {
  int threads = 0;                              ///< 0: all cores
  std::function<bool(double seconds)> go_on{};  ///< asked often, with the seconds of rendering so far; false: stop
};

/// A reference of about `seconds`: mis, random numbers of another seed, exact.
ChartReference render_reference(Scene scene, double seconds, const ChartRun& run);

/// The curve of a method over about `seconds` of rendering, or until the reference's noise would show.
ChartCurve measure_curve(Scene scene, const ChartMethod& method, const ChartReference& reference, double seconds,
                         const ChartRun& run);

}  // namespace tyndall

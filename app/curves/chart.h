#pragma once
#include "app/curves/curve.h"
#include "core/image/image.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Renders a scene in different ways and measures the error of each over time, for the command `chart`. Charts in
/// numbers, words and drawings: their points as CSV, what a comparison of the methods says, and both files.
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

/// Curves and what is said of them, for files and for the table that the command `chart` prints.
struct Chart {
  std::string title, subtitle;
  std::vector<ErrorCurve> curves;
  double reference_noise = 0;  ///< relMSE of what errors were measured against; 0: not known
};

/// A line method,spp,seconds,relmse for each point, below a line with these names.
std::string chart_csv(const Chart& chart);

/// For each method: seconds to relMSE 0.01 and 0.001, how many times faster than the first method it is, and its bias.
std::string chart_table(const Chart& chart);

/// A drawing of seconds against relMSE on logarithmic axes, as SVG. Each curve is named at its end, a guide shows the
/// slope -1 that more samples alone give, floors are dashed. The colours are those of Okabe and Ito (Color Universal
/// Design, 2008), for light and dark pages.
std::string chart_svg(const Chart& chart);

/// The table that is written beside a chart: the same name, ending in .csv.
inline std::filesystem::path csv_beside(std::filesystem::path svg) { return svg.replace_extension(".csv"); }

/// Writes the table and the drawing. svg: name of the drawing. Throws ImageFileError if one of them cannot be written.
void write_chart(const Chart& chart, const std::filesystem::path& svg);

}  // namespace tyndall

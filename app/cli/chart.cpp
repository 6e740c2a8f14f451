#include "app/curves/chart.h"
#include "app/cli/render_setup.h"
#include "app/cli/requests.h"
#include "app/comparison/comparison.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/text/progress.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/seconds.h"
#include "core/system/processors.h"
#include "core/system/signals.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tyndall {
namespace {

constexpr double fraction_of_reference = 0.4;  // of the whole time; the curves get the rest
constexpr double max_pixels =
    256 * 256;  // unless --size asks for more: the error of a pixel does not depend on how many there are

/// The scenes of `chart all`: the light, the fog, the sky, the texture, the glass.
constexpr const char* gallery[] = {"cornell-box", "cornell-smoke", "cover", "simple-light", "hollow-glass", "showroom"};

void make_small(Scene& scene) {
  const double pixels = static_cast<double>(scene.width) * scene.height;
  if (pixels <= max_pixels) return;
  const double scale = std::sqrt(max_pixels / pixels);
  scene.width = std::max(1, static_cast<int>(scene.width * scale));
  scene.height = std::max(1, static_cast<int>(scene.height * scale));
}

class ChartJob {
 public:
  ChartJob(const CommandRequest& command, const SignalWatch& signals)
      : command_(command), signals_(signals), report_(command.progress) {}

  /// svg: the file that the chart is to be written to.
  Chart make(const SceneRequest& request, const std::filesystem::path& svg) {
    LoadedScene loaded = open_scene(request);
    std::vector<std::filesystem::path> inputs = loaded.files;
    if (!command_.reference.empty()) inputs.push_back(picture_name(command_.reference).file);
    check_outputs({{"--output", svg}, {"--output", csv_beside(svg)}}, inputs);
    tell_alpha(loaded);
    Scene& scene = loaded.scene;
    if (!request.size) make_small(scene);
    std::vector<ChartMethod> methods;
    for (const CommandRequest& m : command_.methods) {
      find_kernels(m.isa);
      methods.push_back({m.curve, scene.render, m.isa});
      apply(m.scene.render, methods.back().settings);
    }
    if (methods.empty()) methods = default_methods(scene);
    const double budget = command_.budget;
    Chart chart;
    const ChartReference reference = command_.reference.empty()
                                         ? render_reference(scene, fraction_of_reference * budget, run("reference"))
                                         : read(scene);
    chart.reference_noise = reference.noise;
    const double left = command_.reference.empty() ? (1 - fraction_of_reference) * budget : budget;
    for (std::size_t i = 0; i < methods.size() && !stopped(); ++i)
      chart.curves.push_back(measure_curve(scene, methods[i], reference, left / static_cast<double>(methods.size()),
                                           run(methods[i].name)));
    chart.title = scene.name.empty() ? loaded.name : scene.name;
    const int threads = thread_count(command_.threads).count;
    chart.subtitle = std::to_string(scene.width) + "x" + std::to_string(scene.height) + ", " + std::to_string(threads) +
                     (threads == 1 ? " thread" : " threads") + "; reference: " + reference.about;
    return chart;
  }
  bool stopped() const { return signals_.received() != 0; }
  void finish(const std::string& summary) { report_.finish(summary); }

 private:
  ChartReference read(const Scene& scene) const {
    const std::filesystem::path& file = command_.reference;
    PictureFile picture = read_whole_picture(file);
    for (const std::string& remark : picture.remarks) complain(remark);
    ChartReference reference{std::move(picture.image), 0, file.filename().string()};
    if (reference.image.width != scene.width || reference.image.height != scene.height)
      throw UsageError("--reference: found " + std::to_string(reference.image.width) + "x" +
                       std::to_string(reference.image.height) + " pixels, expected " + std::to_string(scene.width) +
                       "x" + std::to_string(scene.height) + " as the charted picture has (see --size)");
    check_finite(file, reference.image);
    if (is_exr(file))
      if (const auto film = read_film(file)) {
        const double error = estimate_error(*film).relative_error;
        if (std::isfinite(error)) reference.noise = error * error;
      }
    return reference;
  }
  ChartRun run(const std::string& what) {
    return {command_.threads, [this, what](double) {
              const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
              report_.show(seconds, std::min(seconds / command_.budget, 1.0), what);
              return !stopped();
            }};
  }

  const CommandRequest& command_;
  const SignalWatch& signals_;
  ProgressReport report_;
  Clock::time_point start_ = Clock::now();
};

/// Writes the files of a chart, and its table to standard output. Whether all of that worked; what did not is told.
bool write(const Chart& chart, const std::filesystem::path& svg, const std::string& table) {
  const bool saved = written_or_told([&] { write_chart(chart, svg); });
  return written_or_told([&] { write_standard_output(table); }) && saved;
}

int chart_all(const CommandRequest& command, const SignalWatch& signals) {
  const auto file_of = [&command](const char* name) { return command.output / (std::string(name) + ".svg"); };
  for (const char* name : gallery) check_can_write(file_of(name)), check_can_write(csv_beside(file_of(name)));
  bool whole = true;
  for (const char* name : gallery) {
    const std::filesystem::path file = file_of(name);
    ChartJob job(command, signals);
    SceneRequest request = command.scene;
    request.what = name;
    const Chart chart = job.make(request, file);
    if (chart.curves.empty()) break;
    job.finish(std::string("charted ") + name);
    whole = write(chart, file, std::string(name) + "\n" + chart_table(chart) + "\n") && whole;
    if (job.stopped()) break;
  }
  if (!whole) return output_failed;
  return signals.received() ? 128 + signals.received() : 0;
}

}  // namespace

int run_chart(const CommandRequest& command) {
  const SignalWatch signals;
  if (command.scene.what == "all") return chart_all(command, signals);
  check_can_write(command.output);
  check_can_write(csv_beside(command.output));
  ChartJob job(command, signals);
  const Chart chart = job.make(command.scene, command.output);
  const int code = signals.received() ? 128 + signals.received() : 0;
  if (chart.curves.empty() || chart.curves.front().points.empty()) {
    complain("interrupted before the first point: nothing written");
    return code;
  }
  job.finish("charted " + command.scene.what);
  return write(chart, command.output, chart_table(chart)) ? code : output_failed;
}

}  // namespace tyndall

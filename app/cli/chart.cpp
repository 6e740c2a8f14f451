#include "app/curves/chart.h"
#include "app/cli/pictures.h"
#include "app/comparison/comparison.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/seconds.h"

#include <algorithm>
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

ChartReference read_reference(const std::filesystem::path& file, const Scene& scene) {
  PictureFile picture = read_whole_picture(file);
  for (const std::string& remark : picture.remarks) complain(remark);
  ChartReference reference{std::move(picture.image), 0, file.filename().string()};
  if (reference.image.width != scene.width || reference.image.height != scene.height)
    refuse("--reference: found {}x{} pixels, expected {}x{} as the charted picture has (see --size)",
           reference.image.width, reference.image.height, scene.width, scene.height);
  check_finite(file, reference.image);
  if (const auto film = is_exr(file) ? read_film(file) : std::nullopt) {
    const double error = estimate_error(*film).relative_error;
    if (std::isfinite(error)) reference.noise = error * error;
  }
  return reference;
}

std::vector<ChartMethod> methods_of(const CommandRequest& command, const Scene& scene) {
  std::vector<ChartMethod> methods;
  for (const CommandRequest& m : command.methods) {
    find_kernels(m.isa);
    methods.push_back({m.curve, scene.render, m.isa});
    apply(m.scene.render, methods.back().settings);
  }
  return methods.empty() ? default_methods(scene) : methods;
}

/// svg: the file that the chart is to be written to.
Chart make_chart(const CommandRequest& command, const std::string& name, const std::filesystem::path& svg,
                 const SignalWatch& signals, ProgressReport& report) {
  const auto run = [&, start = Clock::now()](const std::string& what) {
    return ChartRun{command.threads, [&, start, what](double) {
                      const double seconds = seconds_since(start);
                      report.show(seconds, std::min(seconds / command.budget, 1.0), what);
                      return signals.received() == 0;
                    }};
  };
  SceneRequest request = command.scene;
  request.what = name;
  LoadedScene loaded = open_scene(request);
  std::vector<std::filesystem::path> inputs = loaded.files;
  const std::filesystem::path& reference_file = command.reference;
  if (!reference_file.empty()) inputs.push_back(picture_name(reference_file).file);
  check_outputs({{"--output", svg}, {"--output", csv_beside(svg)}}, inputs);
  tell_alpha(loaded);
  Scene& scene = loaded.scene;
  if (!request.size) make_small(scene);
  const std::vector<ChartMethod> methods = methods_of(command, scene);
  const double of_reference = reference_file.empty() ? fraction_of_reference * command.budget : 0;
  const ChartReference reference = reference_file.empty() ? render_reference(scene, of_reference, run("reference"))
                                                          : read_reference(reference_file, scene);
  Chart chart{scene.name.empty() ? loaded.name : scene.name, "", {}, reference.noise};
  const double each = (command.budget - of_reference) / static_cast<double>(methods.size());
  for (std::size_t i = 0; i < methods.size() && signals.received() == 0; ++i)
    chart.curves.push_back(measure_curve(scene, methods[i], reference, each, run(methods[i].name)));
  const int threads = thread_count(command.threads).count;
  chart.subtitle = fmt::format("{}x{}, {} thread{}; reference: {}", scene.width, scene.height, threads,
                               threads == 1 ? "" : "s", reference.about);
  return chart;
}

}  // namespace

int run_chart(const CommandRequest& command) {
  const SignalWatch signals;
  const bool all = command.scene.what == "all";
  std::vector<std::string> names{command.scene.what};
  if (all) names.assign(std::begin(gallery), std::end(gallery));
  const auto file_of = [&](const std::string& name) { return all ? command.output / (name + ".svg") : command.output; };
  for (const std::string& name : names) check_can_write(file_of(name)), check_can_write(csv_beside(file_of(name)));
  bool whole = true;
  for (const std::string& name : names) {
    ProgressReport report(command.progress);
    const Chart chart = make_chart(command, name, file_of(name), signals, report);
    if (chart.curves.empty() || chart.curves.front().points.empty()) {
      if (!all) complain("interrupted before the first point: nothing written");
      break;
    }
    report.finish("charted " + name);
    whole = written_or_told([&] { write_chart(chart, file_of(name)); }) && whole;
    const std::string table = chart_table(chart);
    whole =
        written_or_told([&] { write_standard_output(all ? fmt::format("{}\n{}\n", name, table) : table); }) && whole;
    if (signals.received() != 0) break;
  }
  if (!whole) return output_failed;
  return signals.received() != 0 ? 128 + signals.received() : 0;
}

}  // namespace tyndall

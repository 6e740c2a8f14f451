#include "app/cli/requests.h"
#include "app/cli/series.h"
#include "app/files/open_scene.h"
#include "app/report/replay.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/core.h>

namespace tyndall {
namespace {

/// What the picture lacks, if it lacks anything.
std::string losses(const FilmTotals& sum) {
  std::string text;
  if (sum.rejected > 0) text += ", " + std::to_string(sum.rejected) + " samples rejected";
  if (sum.truncated == 0) return text;
  return text + fmt::format(", {:.2g} % of the throughput cut at the longest path", 100 * sum.cut_throughput);
}

std::string summary(const RenderOutcome& outcome, const std::vector<std::filesystem::path>& outputs) {
  const RenderResult& r = outcome.result;
  const RenderProgress end{outcome.picture.spp, r.seconds,
                           r.seconds > 0 ? static_cast<double>(r.rays) / r.seconds * 1e-6 : 0,
                           outcome.picture.estimate.relative_error};
  const std::string clean =
      r.clean ? fmt::format(", filtered to {:.2g} in {:.2g} s", r.clean->relative_error, r.seconds_clean) : "";
  std::string files;
  for (const auto& file : outputs)
    if (file != "-") files += (files.empty() ? "" : ", ") + printable(file.string());
  return (r.interrupted ? "interrupted: " : "done: ") + files + (files.empty() ? "" : ": ") + progress_text(end, {}) +
         clean + losses(outcome.picture.totals);
}

int print_replay(const CommandRequest& command) {
  OwnSamples own;
  const LoadedScene loaded = open_frame(command, own);
  const SampleKey& key = *command.replay;
  const Scene& scene = loaded.scene;
  if (key.x >= scene.width || key.y >= scene.height)
    throw UsageError("--replay: found pixel " + std::to_string(key.x) + "," + std::to_string(key.y) +
                     ", expected one of an image of " + std::to_string(scene.width) + "x" +
                     std::to_string(scene.height));
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  write_standard_output(replay_text(scene, prepared->columns(), replay(prepared->view(), key.x, key.y, key.sample)));
  return 0;
}

}  // namespace

int run_render(const CommandRequest& command) {
  if (command.replay) return print_replay(command);
  check_names(command);
  RenderJob job{command};
  job.loaded = open_frame(command, job.own);
  prepare(job);
  if (!job.begin.note.empty()) complain(job.begin.note);
  if (job.begin.as_requested) return 0;
  Series series(command.progress, 1);
  const auto rendered = [&](const RenderOutcome& outcome) {
    series.finish(summary(outcome, command.outputs));
    if (outcome.picture.totals.max_taken == 0) complain("interrupted before the first samples: nothing written");
  };
  const bool written = series.make(job, "", {rendered, {}, {}});
  return written ? series.made() == 1 ? 0 : 128 + series.signal() : output_failed;
}

}  // namespace tyndall

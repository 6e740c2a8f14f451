#pragma once
#include "app/cli/live_view.h"
#include "app/cli/render_setup.h"
#include "app/text/progress.h"
#include "core/files/stats.h"
#include "core/system/processors.h"
#include "core/system/signals.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// One headless render from command to files. `render` makes one; `sweep` and `animate` make one for each picture.
namespace tyndall {

struct RenderJob {
  const CommandRequest& command;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  LoadedScene loaded{};     ///< what the command's scene is; see open_scene_or_samples()
  OwnSamples own{};         ///< where it is a picture
  bool whole_only = false;  ///< of a picture that is unfinished only a film is written, which can be gone on with
  bool is_there = false;    ///< an earlier run has written all of it
  ThreadCount threads = thread_count(command.threads);
  RenderOptions options{};
  Kernels kernels{};
  RenderStart begin{};
  std::shared_ptr<const PreparedScene> prepared{};
  std::unique_ptr<LiveView> view{};  ///< in a viewer; null: none
  std::uint64_t samples_before = 0;
  double seconds_build = 0;
};

/// What a render has come to, at its end or when it is asked for in between.
struct RenderOutcome {
  const RenderResult& result;
  FinishedPicture picture;
  bool unfinished = false;  ///< more samples are to come
};
RenderOutcome outcome_of(const RenderJob& job, const RenderResult& result, bool unfinished);

/// Checks the names of the outputs, before any file is read.
void check_names(const CommandRequest& command);
/// Finds everything else that can be wrong before the first sample, and where the render begins.
void prepare(RenderJob& job);
/// Remarks on what the user may not expect of the outputs, settings and textures.
void tell_remarks(const RenderJob& job);

ProgressGoal goal_of(const RenderJob& job);
/// Renders, with checkpoints. show: gets the progress.
RenderResult render(RenderJob& job, const SignalWatch& signals, ProgressReport& report,
                    const std::function<void(const RenderProgress&)>& show);

/// What users should know of the picture, a line each, also with -q, which only turns progress off.
std::vector<std::string> warnings(const RenderJob& job, const RenderOutcome& outcome);
/// Writes all that can be written; false if something could not. at_end: also what goes to standard output or pipes.
bool write(const RenderJob& job, const RenderOutcome& outcome, bool at_end = true);

/// Shows the finished picture in the viewer. Files are written by then, and nothing that fails here is an error.
void show_last(const RenderJob& job, const RenderOutcome& outcome);

}  // namespace tyndall

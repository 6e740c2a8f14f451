#pragma once
#include "app/cli/requests.h"
#include "app/files/outputs.h"
#include "app/files/viewer_stream.h"
#include "app/text/progress.h"
#include "core/clean/clean.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/system/processors.h"
#include "core/system/signals.h"
#include "core/targets/kernels.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

/// The pictures that a command renders, one after the other, from what the user asked for to files: a render is a list
/// of one.
namespace tyndall {

/// The kernels of an instruction set ("": the best). Throws UsageError if this build or CPU has none of that name.
Kernels find_kernels(const std::string& isa);

/// The same for commands that may run for hours: "" must find more than the scalar kernels where the CPU runs wider
/// ones.
Kernels kernels_to_render(const std::string& isa);

/// The scene of a command, with --frame the one of that frame.
LoadedScene open_frame(const CommandRequest& command, OwnSamples& own);

/// One headless render from command to files. `render` makes one; `sweep` and `animate` make one for each picture.
struct RenderJob {
  CommandRequest command;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  LoadedScene loaded{};          ///< what the command's scene is; see open_scene_or_samples()
  OwnSamples own{};              ///< where it is a picture
  bool whole_only = false;       ///< of a picture that is unfinished only a film is written, which can be gone on with
  std::filesystem::path film{};  ///< that an earlier run has finished; empty: the picture is to be rendered
  ThreadCount threads = thread_count(command.threads);
  RenderOptions options{};
  Kernels kernels{};
  FilmPlace place{};      ///< where the film is kept
  Film begin{};           ///< the film to go on from; empty: the render starts anew
  bool complete = false;  ///< it has all samples that are asked for, and its file what would be written into it
  std::string note{};     ///< what to tell of it; "": nothing
  std::shared_ptr<const PreparedScene> prepared{};
  std::uint64_t samples_before = 0;
  double seconds_build = 0;
};

/// Finds the kernels, and limits and region of a render: so much that its picture can be compared with what is there.
/// spp is always set; where only time or error end the render, to max_samples. The job needs its scene. Throws
/// UsageError for a region beyond the image and for adaptive sampling of a range.
void set_up(RenderJob& job);

/// Remarks on what the user may not expect of the outputs, settings and textures. Outputs that nothing can take the
/// place of are told where that costs something: checkpoints go to another file or nowhere, and where the folder takes
/// no new files, what cannot be written into an output goes far from it.
void tell_remarks(const RenderJob& job);

/// One line on standard error if textures of the scene have an alpha channel, which is not looked at.
void tell_alpha(const LoadedScene& loaded);

/// Makes the frames, which takes the threads' time, and so seldom that this costs less than 1 % of it; of a viewer that
/// is not there, or does not read, none are made. The clean view takes most of the time, so it comes more seldom, and
/// always at the end.
class LiveView {
 public:
  /// The job is prepared, and lives longer.
  explicit LiveView(const RenderJob& job);

  bool due() const;
  /// Sends the film as it is. thread_pool: idle.
  void take(const Film& film, ThreadPool& thread_pool);
  /// Sends the finished picture and waits until the viewer has it, as ViewerStream::finish() does. clean: the film's
  /// clean view, null: it is made here. Does nothing if there is no viewer.
  void finish(const Film& film, const CleanPicture* clean);
  /// What went wrong with the viewer, once.
  std::optional<std::string> problem() { return stream_.problem(); }

 private:
  using Clock = std::chrono::steady_clock;
  void filter(const Film& film);
  void send(const Film& film, ThreadPool& thread_pool);

  const RenderJob& job_;
  ViewerStream stream_;
  std::vector<float> clean_;  ///< the newest; empty: none yet
  Clock::time_point start_ = Clock::now(), last_ = start_, last_clean_ = start_;
  double cost_ = 0;        ///< seconds that the last frame took, or an estimate
  double clean_cost_ = 0;  ///< likewise the clean view
};

/// Checks the names of the outputs, before any file is read.
void check_names(const CommandRequest& command);
/// Finds everything else that can be wrong before the first sample, and where the render begins.
void prepare(RenderJob& job);

/// What a render has come to, at its end or when it is asked for in between.
struct RenderOutcome {
  const RenderResult& result;
  FinishedPicture picture;
};

/// What a command does with a whole picture: before its files are written, and when they are, or could not be. Both may
/// be empty.
struct PictureSteps {
  std::function<void()> writing;
  std::function<void(const RenderOutcome&, bool written)> made;
};

/// Renders and writes each, and tells how far all of them are.
class Series {
 public:
  /// count: of pictures that are to be rendered.
  Series(ProgressStyle style, std::size_t count) : report_(style), count_(count) {}

  /// Makes the picture of a job that is prepared. name: "frame 12"; "": it is the only one, which is summed up. False
  /// if something could not be written.
  bool make(RenderJob& job, const std::string& name = "", const PictureSteps& steps = {});
  void finish(const std::string& summary) { report_.finish(summary); }

  /// The signal that asked for an end; 0: none did.
  int signal() const { return signals_.received(); }
  std::size_t made() const { return made_; }   ///< pictures that are whole
  double seconds() const { return seconds_; }  ///< of rendering
  std::size_t left() const { return count_ - made_; }

 private:
  RenderResult render(RenderJob& job, const std::string& name, LiveView* view);
  void warn(const RenderJob& job, const RenderOutcome& outcome, const std::string& name);

  SignalWatch signals_;
  ProgressReport report_;
  std::size_t count_, begun_ = 0, made_ = 0;
  double seconds_ = 0;
  std::set<std::string> told_;
};

}  // namespace tyndall

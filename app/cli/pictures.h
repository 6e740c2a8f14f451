#pragma once
#include "app/cli/requests.h"
#include "app/files/outputs.h"
#include "app/text/progress.h"
#include "core/base/seconds.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/system/processors.h"
#include "core/system/signals.h"
#include "core/targets/kernels.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

/// The pictures that a command renders, one after the other, from what the user asked for to files: a render is a list
/// of one.
namespace tyndall {

/// The kernels of an instruction set ("": the best). Throws UsageError if this build or CPU has none of that name.
Kernels find_kernels(const std::string& isa);

/// A list beside numbered pictures of formats that carry no settings: which frames are whole, and what they are of.
///
/// Lines are only ever added, so that several machines can write into one list, and a line that was cut off by a kill
/// costs one frame: "3 begun 0123456789abcdef" before the frame's file is written, "3 whole 0123456789abcdef" after it.
struct FrameList {
  std::filesystem::path file{};
  std::map<int, std::string> entries{};  ///< of frames: "begun 0123456789abcdef", the last one that was read
};
/// Reads the list, which need not be there.
FrameList read_frame_list(const std::filesystem::path& file);
/// Adds an entry to the list in a file. Throws IoError.
void add_frame(const std::filesystem::path& list, int frame, const std::string& entry);

/// One headless render from command to files. `render` makes one; `sweep` and `animate` make one for each picture.
struct RenderJob {
  CommandRequest command;  ///< and the options of the render, which set_up() completes
  Clock::time_point start = Clock::now();
  LoadedScene loaded{};  ///< what the command's scene is; see open_scene_or_samples()
  OwnSamples own{};      ///< where it is a picture
  /// "frame 12", of which, unfinished, only a film is written, which can be gone on with; "": the only picture.
  std::string name{};
  /// Beside outputs whose formats carry no settings.
  std::map<std::filesystem::path, const FrameList*> lists{};
  std::filesystem::path film{};  ///< that an earlier run has finished; empty: the picture is to be rendered
  ThreadCount threads = thread_count(command.threads);
  Kernels kernels{};
  FilmPlace place{};      ///< where the film is kept
  Film begin{};           ///< the film to go on from; empty: the render starts anew
  bool complete = false;  ///< it has all samples that are asked for, and its file what would be written into it
  std::string note{};     ///< what to tell of it; "": nothing
  std::shared_ptr<const PreparedScene> prepared{};
  std::uint64_t samples_before = 0;
  double seconds_build = 0;
};

/// Finds the kernels, and completes the command's limits and region: so much that its picture can be compared with what
/// is there. spp is always set; where only time or error end the render, to max_samples. The job needs its scene.
/// Throws UsageError for a region beyond the image and for adaptive sampling of a range.
void set_up(RenderJob& job);

/// Remarks on what the user may not expect of the outputs, settings and textures. Outputs that nothing can take the
/// place of are told where that costs something: checkpoints go to another file or nowhere, and where the folder takes
/// no new files, what cannot be written into an output goes far from it.
void tell_remarks(const RenderJob& job);

/// One line on standard error if textures of the scene have an alpha channel, which is not looked at.
void tell_alpha(const LoadedScene& loaded);

// What an earlier run has left of the pictures that a command is to make, so that a killed one goes on.

/// Looks at the film in the .exr output, or in the unfinished file beside it (see FilmPlace) if that is there. One that
/// fits is gone on with if it is unfinished, has just the samples that are asked for, or --resume asks for it. Throws
/// UsageError where --resume finds no film that fits, and for an unfinished one that does not fit: it says what
/// differs; likewise for unfinished ones in further outputs. Any other file is replaced in the end. Here and below the
/// job has been set up.
void find_start(RenderJob& job);

/// Says in the lists beside the job's outputs that they are "begun" or "whole".
void list_outputs(const RenderJob& job, const std::string& state);

/// What is left to do for a picture of which an earlier run may have written some files.
struct PictureTask {
  std::vector<std::filesystem::path> outputs;  ///< files that are not whole
  std::filesystem::path film;                  ///< the first whole file that holds its film; empty: none does
};
/// With --fresh all is to be done. Of a sweep, which compares films, other formats than EXR are made anew. Throws
/// UsageError if a file is of something else: no picture of the same scene, settings and version.
PictureTask task_of(const RenderJob& job);

/// 16 hexadecimal digits that differ with the job's scene, settings, version and instruction set.
std::string picture_mark(const RenderJob& job);

/// Checks the names of the outputs, before any file is read.
void check_names(const CommandRequest& command);
/// Finds everything else that can be wrong before the first sample, and where the render begins.
void prepare(RenderJob& job);

/// What a render has come to, at its end or when it is asked for in between.
struct RenderOutcome {
  const RenderResult& result;
  FinishedPicture picture;
};

/// Pictures that are made one after the other, and how far all of them are.
struct Series {
  ProgressReport report;
  std::size_t count;      ///< of pictures that are to be rendered
  SignalWatch signals{};  ///< what asks for an end
  std::size_t made = 0;   ///< those that are whole
  double seconds = 0;     ///< of rendering
  std::set<std::string> told{};
};

/// Makes the picture of a job that is prepared, and sums up the only one. False if something could not be written.
/// made: called with a whole picture when its files are written, or could not be.
bool make(Series& series, RenderJob& job, const std::function<void(const RenderOutcome&, bool written)>& made = {});

}  // namespace tyndall

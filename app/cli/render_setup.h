#pragma once
#include "app/cli/requests.h"
#include "app/files/outputs.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/system/processors.h"
#include "core/targets/kernels.h"

#include <chrono>
#include <memory>
#include <string>

/// Turns what the user asked for into what render() is told.
namespace tyndall {

/// The kernels of an instruction set ("": the best). Throws UsageError if this build or CPU has none of that name.
Kernels find_kernels(const std::string& isa);

/// The same for commands that may run for hours: "" must find more than the scalar kernels where the CPU runs wider
/// ones.
Kernels kernels_to_render(const std::string& isa);

/// The scene of a command, with --frame the one of that frame.
LoadedScene open_frame(const CommandRequest& command, OwnSamples& own);

/// Where a render begins: anew, or with the film that its .exr output holds already.
struct RenderStart {
  Film film;  ///< to go on from; empty: the render starts anew
  bool as_requested =
      false;  ///< the film has all samples that are asked for, and the file holds what the command would write into it
  std::string note;  ///< what to tell the user; "": nothing
  FilmPlace place;   ///< where the film is kept
};

/// One headless render from command to files. `render` makes one; `sweep` and `animate` make one for each picture.
struct RenderJob {
  CommandRequest command;
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
  std::shared_ptr<class LiveView> view{};  ///< in a viewer; null: none
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

}  // namespace tyndall

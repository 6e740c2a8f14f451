#pragma once
#include "app/cli/requests.h"
#include "app/files/outputs.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/targets/kernels.h"

#include <string>
#include <vector>

/// Turns what the user asked for into what render() is told.
namespace tyndall {

/// The kernels of an instruction set ("": the best). Throws UsageError if this build or CPU has none of that name.
Kernels find_kernels(const std::string& isa);

/// The same for commands that may run for hours: "" must find more than the scalar kernels where the CPU runs wider
/// ones.
Kernels kernels_to_render(const std::string& isa);

/// The scene of a command, with --frame the one of that frame.
LoadedScene open_frame(const CommandRequest& command, OwnSamples& own);

/// Limits and region of a render. spp is always set; where only time or error end the render, to max_samples.
/// Throws UsageError for a region beyond the image and for adaptive sampling of a range.
RenderOptions render_options(const CommandRequest& command, const LoadedScene& loaded);

/// Where a render begins: anew, or with the film that its .exr output holds already.
struct RenderStart {
  Film film;  ///< to go on from; empty: the render starts anew
  bool as_requested =
      false;  ///< the film has all samples that are asked for, and the file holds what the command would write into it
  std::string note;  ///< what to tell the user; "": nothing
  FilmPlace place;   ///< where the film is kept
};

/// Looks at the film in the .exr output, or in the unfinished file beside it (see FilmPlace) if that is there. One that
/// fits is gone on with if it is unfinished, has just the samples that
/// are asked for, or --resume asks for it. Throws UsageError where --resume finds no film that fits, and for an
/// unfinished one that does not fit: it says what differs; likewise for unfinished ones in further outputs. Any other
/// file is replaced in the end.
RenderStart find_start(const CommandRequest& command, const LoadedScene& loaded, const RenderOptions& options,
                       const Kernels& kernels);

/// One line on standard error if a film that fits does not say which pixels its textures and sky had.
void tell_contents(const StoredFilm& film);

/// One line on standard error if textures of the scene have an alpha channel, which is not looked at.
void tell_alpha(const LoadedScene& loaded);

/// What to tell of outputs that nothing can take the place of, where that costs something: checkpoints go to another
/// file or nowhere, and where the folder takes no new files, what cannot be written into an output goes far from it.
std::vector<std::string> remarks_on_outputs(const CommandRequest& command, const FilmPlace& film);

/// What keeps a render from going on with a film, as "found X, expected Y" without "found"; "": nothing does.
std::string differing_film(const StoredFilm& stored, const CommandRequest& command, const LoadedScene& loaded,
                           const RenderOptions& options, const Kernels& kernels);

}  // namespace tyndall

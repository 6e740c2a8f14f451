#pragma once
#include "core/accuracy/estimate.h"
#include "core/base/thread_pool.h"
#include "core/clean/clean.h"
#include "core/film/film.h"
#include "core/image/image.h"
#include "core/render/prepare.h"
#include "core/render/single_pixels.h"
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>

/// Blocking renders: for the command line, tests and charts.
namespace tyndall {

struct RenderResult;

/// What a caller does with a picture while it is rendered. About every 50 ms it is asked whether that is due. If it is,
/// the threads stop within one tile job (2 ms), wait until it is done on the calling thread, and go on. That changes no
/// sample. Each may be empty.
struct RenderBreaks {
  std::function<bool()> film_due;
  std::function<void(const Film&, ThreadPool&)> take_film;  ///< gets the threads, too, which have nothing else to do
  std::function<bool()> result_due;
  std::function<void(const RenderResult&)> take_result;  ///< gets what render() would return now
};

struct RenderOptions {
  int threads = 0;                 ///< 0: see thread_count()
  std::string isa;                 ///< "": the best
  std::optional<Region> region;    ///< absent: the whole image
  std::uint32_t first_sample = 0;  ///< index of the first sample
  /// Samples a pixel at which to stop, those of a continued film included (see also `adaptive`); absent: no limit.
  std::optional<std::uint32_t> spp;
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds at which to stop; looked at between passes
  double target_error = 0;  ///< estimated relative error at which to stop, with `clean` that of the clean view; 0: none
  bool clean = false;       ///< make the clean view, too; needs 2 samples a pixel
  bool adaptive = false;    ///< more samples where the error is larger (see plan.h); spp is then their mean
  int tile = 0;             ///< edge of a tile in pixels; 0: chosen. Never changes the picture.
  RenderBreaks breaks{};
};

struct RenderProgress {
  std::uint32_t spp = 0;  ///< samples a pixel so far; adaptive: their mean
  double seconds = 0;     ///< rendering so far
  double mrays_per_s = 0;
  double relative_error = 0;  ///< estimated; infinite before two samples
};

struct RenderResult {
  Film film;
  std::vector<RejectedSample> first_rejected;  ///< a few, if there are any
  std::uint64_t rays = 0, shadow_rays = 0;
  double seconds = 0;  ///< from the first sample started to the last film write, thread start included
  int threads = 0;
  Kernels kernels{};         ///< those that made the film
  bool interrupted = false;  ///< the callback said stop
  /// Of this film, with levels of the pixels that decide it; absent if neither a limit nor the callback asked for it.
  std::optional<ErrorEstimate> estimate{};
  std::optional<CleanPicture> clean{};  ///< the clean view of the film as it is, if it was asked for
  double seconds_clean = 0;             ///< spent on filtering in all; only what came before the end is in `seconds`
};

/// Called on the calling thread between passes, and about every 50 ms within long ones. Returns false to stop.
using ProgressCallback = std::function<bool(const RenderProgress&)>;

/// Renders until the first of the limits is reached. Goes on with `film` if it is not empty: it must be of this scene
/// and region, and made with the same `adaptive`. Throws std::invalid_argument for an unknown options.isa,
/// std::bad_alloc where the film does not fit into memory.
RenderResult render(const PreparedScene& scene, const RenderOptions& options, const ProgressCallback& progress = {},
                    Film film = {});

/// The error of a film of the scene, with levels of the pixels that decide it (see ask_levels()). threads: 0: see
/// thread_count().
ErrorEstimate estimate_error(const PreparedScene& scene, const Kernels& kernels, const Film& film, int threads = 0);

/// Everything that is reported about a finished film. For each part the whole film has to be read, so the parts are
/// found once, here, and given to all that print or write them.
struct FinishedPicture {
  FilmTotals totals;
  std::uint32_t spp = 0;  ///< see labelled_spp
  ErrorEstimate estimate;
  LinearImage image;             ///< the pixels' means
  std::uint64_t hash = 0;        ///< see image_hash
  std::uint64_t clean_hash = 0;  ///< the same of the clean view; 0: there is none
  /// The estimated error cannot be trusted: see has_rare_bright_paths() and is_doubtful().
  bool rare_bright_paths = false;
};
/// scene: of which `result` is the picture.
FinishedPicture finished_picture(const PreparedScene& scene, const RenderResult& result);

}  // namespace tyndall

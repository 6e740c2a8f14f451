#pragma once
#include "core/accuracy/estimate.h"
#include "core/base/thread_pool.h"
#include "core/clean/clean.h"
#include "core/film/film.h"
#include "core/image/image.h"
#include "core/render/prepare.h"
#include "core/render/sample_source.h"
#include "core/render/single_pixels.h"
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

/// Blocking renders: for the command line, tests and charts.
namespace tyndall {

struct RenderResult;

/// What a caller does with a picture while it is rendered. The *_due functions are called about every 50 ms. If one
/// returns true, the threads stop within one tile job (2 ms), wait while the calling thread runs the matching function,
/// and continue. This changes no sample. Each function may be empty.
struct RenderBreaks {
  std::function<bool()> film_due;
  std::function<void(const Film&, ThreadPool&)> take_film;  ///< also gets the threads, which are idle then
  std::function<bool()> result_due;
  std::function<void(const RenderResult&)> take_result;  ///< gets what render() would return now
};

struct RenderOptions {
  int threads = 0;                 ///< 0: see thread_count()
  std::string isa{};               ///< "": the best
  std::optional<Region> region{};  ///< absent: the whole image
  std::uint32_t first_sample = 0;  ///< index of the first sample
  /// Samples a pixel at which to stop, those of a continued film included (see also `adaptive`); absent: no limit.
  std::optional<std::uint32_t> spp{};
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds at which to stop; checked between passes
  double target_error = 0;  ///< estimated relative error at which to stop, with `clean` that of the clean view; 0: none
  bool clean = false;       ///< make the clean view, too; needs 2 samples a pixel
  bool adaptive = false;    ///< more samples where the error is larger (see plan.h); spp is then their mean
  /// Where samples come from; null: from the scene, which otherwise gives size, seed and sampler (see RenderRequest).
  std::shared_ptr<const SampleSource> samples{};
  int tile = 0;  ///< edge of a tile in pixels; 0: chosen. Never changes the picture.
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
  std::uint64_t split_events = 0;  ///< events at glass after which both ways were followed: transport/splitting.h
  double seconds = 0;              ///< from the first sample started to the last film write, thread start included
  int threads = 0;
  Kernels kernels{};         ///< that made the film
  bool interrupted = false;  ///< the callback stopped the render
  /// Of this film, with levels of the pixels that decide it; absent if neither a limit nor the callback needed it.
  std::optional<ErrorEstimate> estimate{};
  std::optional<CleanPicture> clean{};  ///< the clean view of the present film, if wanted
  double seconds_clean = 0;             ///< spent on filtering; only filtering before the end is in `seconds`
};

/// Called on the calling thread between passes, and about every 50 ms within long ones. Returns false to stop.
using ProgressCallback = std::function<bool(const RenderProgress&)>;

/// Renders until the first limit is reached. Continues `film` if it is not empty: it must be of this scene and region,
/// and made with the same `adaptive`. Throws std::invalid_argument for an unknown options.isa, std::bad_alloc if the
/// film does not fit into memory.
RenderResult render(const PreparedScene& scene, const RenderOptions& options, const ProgressCallback& progress = {},
                    Film film = {});

/// The error of a film of the scene, with levels of the pixels that decide it (see ask_levels()). threads: 0: see
/// thread_count().
ErrorEstimate estimate_error(const PreparedScene& scene, const Kernels& kernels, const Film& film, int threads = 0);

/// All that is reported about a finished film. Each part takes one pass over the whole film, so the parts are computed
/// once, here, and given to everything that prints or writes them.
struct FinishedPicture {
  FilmTotals totals;
  std::uint32_t spp = 0;  ///< see labelled_spp
  ErrorEstimate estimate;
  LinearImage image;             ///< the pixels' means
  std::uint64_t hash = 0;        ///< see image_hash
  std::uint64_t clean_hash = 0;  ///< likewise of the clean view; 0: there is none
  /// The estimated error cannot be trusted: see has_rare_bright_paths() and is_doubtful().
  bool rare_bright_paths = false;
};
/// scene: that of `result`.
FinishedPicture finished_picture(const PreparedScene& scene, const RenderResult& result);

}  // namespace tyndall

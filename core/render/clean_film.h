#pragma once
#include "core/clean/clean.h"
#include "core/render/pictures.h"
#include "core/render/prepare.h"
#include "core/render/progression.h"

#include <cstdint>
#include <memory>

/// The clean view of films: collects what the filter in core/clean reads, and decides when a picture that is still
/// being rendered is filtered.
namespace tyndall {

/// Samples a pixel from which on a picture can be filtered: one in each half.
inline constexpr std::uint32_t min_clean_spp = 2;
/// With fewer samples a pixel than this, the filtered picture's error is known only roughly.
inline constexpr std::uint32_t rough_clean_spp = 16;
/// Whether its error is known only roughly although it has so many samples.
inline bool is_doubtful(const CleanPicture& picture, std::uint32_t spp) {
  return spp >= rough_clean_spp && picture.rests_on_few_pixels;
}

/// How finely a picture's first-seen planes were made.
struct FirstSeenParts {
  Region region;
  std::int64_t unlike = 0;  ///< pixels that see something else than their neighbours, as at edges and in textures
  int parts = 0;            ///< these are the mean over parts x parts rays; the others show what their centre sees
};

/// Into how many parts unlike pixels are divided in each direction: at most 8, and so few that what is seen first takes
/// at most as many rays as the samples of the picture.
int parts_of_pixels(const FirstSeenParts& made, double spp);

/// Fills input.seen for the pixels of a region, of a picture of input.spp samples a pixel, and tells in `made` how.
/// Returns false if `give_up` was set before the end; `input.seen` and `made` are then of no use.
bool find_first_seen(const Region& region, const RenderEngine& engine, const std::atomic<bool>& give_up,
                     CleanInput& input, FirstSeenParts& made);

/// Filters films, and keeps what is first seen until the scene changes.
class FilmCleaner {
 public:
  /// Filters with the instruction set of these kernels.
  explicit FilmCleaner(const Kernels& kernels);

  /// The scene has changed: what is first seen has to be found anew.
  void change_scene() { seen_ = {}; }
  /// See Cleaner::run. Every pixel of the film must have min_clean_spp samples or more. levels: of its pixels; null:
  /// the picture's error is of no interest.
  bool run(const Film& film, const RenderEngine& engine, PixelLevels* levels, const std::atomic<bool>& give_up,
           CleanPicture& out);

 private:
  Cleaner cleaner_;
  CleanInput input_;
  FirstSeenParts seen_;  ///< how input_.seen was made; no parts: not yet
};

/// The first clean view after an edit: a picture with fewer pixels, which is there long before every pixel of the whole
/// picture has the two samples that the filter needs. Keeps its memory from one to the next.
class CoarseCleaner {
 public:
  explicit CoarseCleaner(const Kernels& kernels) : cleaner_(kernels) {}

  /// Fills `out` with the clean view of a picture of the scene of which each pixel covers step x step pixels and has
  /// two samples of its own, which are in no film. quantum: see Film. Returns false if `give_up` was set before the
  /// end.
  bool run(int step, const RenderEngine& engine, double quantum, const std::atomic<bool>& give_up, CleanPicture& out);

 private:
  FilmCleaner cleaner_;
  Film film_;
};

/// The clean view of a finished film of the scene. threads: 0: see thread_count(); isa: "": the best.
CleanPicture clean_film(const Film& film, const PreparedScene& scene, int threads, const std::string& isa);

/// The clean view of a picture that is being rendered: when it is made, and the newest one.
class LiveClean {
 public:
  explicit LiveClean(const Kernels& kernels) : cleaner_(kernels), coarse_(kernels) {}

  void set_wanted(bool wanted);
  /// The scene has changed: what is first seen has to be found anew.
  void change_scene() { cleaner_.change_scene(); }
  /// The picture begins anew.
  void start_over();

  /// Whether it is time to make one: when the picture has two samples a pixel, then whenever the samples have doubled,
  /// as long as filtering takes at most a quarter of the time since the start, and once more at the end. at_rest: no
  /// more samples are to be taken.
  bool is_due(const Progression& picture, bool at_rest) const;
  /// Makes one. False if `give_up` was set before the end: then it stays due.
  bool make(Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up);
  /// Makes a coarse one, if a whole one would take long: see coarse_clean_step. paths_per_second: <= 0: unknown. False
  /// if none is wanted or needed, or if `give_up` was set before the end.
  bool make_coarse(const Film& film, double paths_per_second, const RenderEngine& engine,
                   const std::atomic<bool>& give_up);
  /// The newest one of this picture; null: there is none, or none is wanted.
  const std::shared_ptr<const CleanFrame>& latest() const { return latest_; }

 private:
  std::shared_ptr<CleanFrame> take_frame(const PictureGrid& grid, ThreadPool& thread_pool);

  FilmCleaner cleaner_;
  CoarseCleaner coarse_;
  CleanPicture picture_;
  CleanFrameMemory frames_, coarse_frames_;
  std::shared_ptr<const CleanFrame> latest_;
  bool wanted_ = false;
  std::uint32_t made_of_ = 0;        ///< samples a pixel that the newest one was made from; 0: none was made yet
  std::uint32_t made_of_max_ = 0;    ///< samples of the pixels that were refined first by then
  double spent_ = 0;                 ///< seconds spent on all clean views of the present picture
  double last_seconds_ = 0;          ///< seconds that the newest one took
  double seconds_per_pixel_ = 2e-7;  ///< of filtering, as the newest one took
};

}  // namespace tyndall

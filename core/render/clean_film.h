#pragma once
#include "core/clean/clean.h"
#include "core/render/prepare.h"
#include "core/render/progression.h"
#include "core/render/views.h"

#include <cstdint>
#include <memory>

/// The clean view of films: collects what the filter in core/clean reads, and decides when a picture that is still
/// being rendered is filtered.
namespace tyndall {

/// Samples a pixel from which on a picture can be filtered: one in each half.
inline constexpr std::uint32_t min_clean_spp = 2;
/// With fewer samples a pixel than this, the filtered picture's error is known only roughly.
inline constexpr std::uint32_t rough_clean_spp = 16;
/// Whether the filtered picture's error is known only roughly although it has so many samples.
inline bool is_doubtful(const CleanPicture& picture, std::uint32_t spp) {
  return spp >= rough_clean_spp && picture.rests_on_few_pixels;
}

/// How finely a picture's first-seen planes were sampled.
struct FirstSeenParts {
  Region region;
  std::int64_t unlike = 0;  ///< pixels that see something else than their neighbours, as at edges and in textures
  int parts = 0;  ///< unlike pixels hold the mean over parts x parts rays, other pixels what their centre sees
};

/// Number of parts into which unlike pixels are divided in each direction: at most 8, and so few that the planes take
/// at most as many rays as the samples of the picture.
int parts_of_pixels(const FirstSeenParts& made, double spp);

/// Fills input.seen for the pixels of a region of a picture of input.spp samples a pixel, and sets `made`. Returns
/// false if `give_up` was set before the end; `input.seen` and `made` are then not usable.
bool find_first_seen(const Region& region, const RenderEngine& engine, const std::atomic<bool>& give_up,
                     CleanInput& input, FirstSeenParts& made);

/// Filters films, and keeps the first-seen planes until the scene changes.
class FilmCleaner {
 public:
  /// Filters with the instruction set of these kernels.
  explicit FilmCleaner(const Kernels& kernels);

  /// The scene has changed: the first-seen planes have to be computed anew.
  void change_scene() { seen_ = {}; }
  /// See Cleaner::run. Every pixel of the film must have at least min_clean_spp samples. levels: of its pixels; null:
  /// the error of the picture is not needed.
  bool run(const Film& film, const RenderEngine& engine, PixelLevels* levels, const std::atomic<bool>& give_up,
           CleanPicture& out);
  /// The first clean view after an edit, ready long before every pixel of the whole picture has the two samples that
  /// the filter needs: of a picture in which each pixel covers step x step pixels of the scene's picture and has two
  /// samples of its own, which go into no film. quantum: see Film.
  bool run_coarse(int step, const RenderEngine& engine, double quantum, const std::atomic<bool>& give_up,
                  CleanPicture& out);

 private:
  Cleaner cleaner_;
  CleanInput input_;
  FirstSeenParts seen_;  ///< how input_.seen was made; no parts: not yet
  Film coarse_film_;
};

/// The clean view of a finished film of the scene. threads: 0: see thread_count(); isa: "": the best.
CleanPicture clean_film(const Film& film, const PreparedScene& scene, int threads, const std::string& isa);

/// The clean view of a picture in the making: decides when to make it, and holds the newest one.
class LiveClean {
 public:
  explicit LiveClean(const Kernels& kernels) : cleaner_(kernels), coarse_(kernels) {}

  void set_wanted(bool wanted);
  /// The scene has changed: the first-seen planes have to be computed anew.
  void change_scene() { cleaner_.change_scene(); }
  /// The picture starts anew.
  void start_over();

  /// Whether it is time to make a clean view: when the picture has two samples a pixel, then whenever the samples have
  /// doubled, as long as filtering takes at most a quarter of the time since the start, and once more at the end.
  /// at_rest: no more samples will be taken.
  bool is_due(const Progression& picture, bool at_rest) const;
  /// Makes a clean view. Returns false if `give_up` was set before the end: then it stays due.
  bool make(Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up);
  /// Makes a coarse one, if a whole one would take long: see coarse_clean_step. paths_per_second: <= 0: unknown.
  /// Returns false if none is wanted or needed, or if `give_up` was set before the end.
  bool make_coarse(const Film& film, double paths_per_second, const RenderEngine& engine,
                   const std::atomic<bool>& give_up);
  /// The newest clean view of this picture; null: there is none, or none is wanted.
  const std::shared_ptr<const CleanFrame>& latest() const { return latest_; }

 private:
  std::shared_ptr<CleanFrame> take_frame(const PictureGrid& grid, ThreadPool& thread_pool);

  FilmCleaner cleaner_, coarse_;
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

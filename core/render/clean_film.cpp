#include "core/render/clean_film.h"

#include "core/base/seconds.h"
#include "core/render/preview.h"

#include <new>

namespace tyndall {

FilmCleaner::FilmCleaner(const Kernels& kernels) : cleaner_(find_target(kernels.isa).value_or(Target::scalar)) {}

bool FilmCleaner::run(const Film& film, const RenderEngine& engine, PixelLevels* levels,
                      const std::atomic<bool>& give_up, CleanPicture& out) {
  if (!read_film(film, engine.thread_pool, give_up, input_)) return false;
  input_.grouped = engine.scene.reuses_paths;
  const bool seen = seen_.parts > 0 && seen_.region == film.region && seen_.parts == parts_of_pixels(seen_, input_.spp);
  if (!seen) {
    change_scene();
    FirstSeenParts made;
    if (!find_first_seen(film.region, engine, give_up, input_, made)) return false;
    seen_ = made;
  }
  return cleaner_.run(input_, engine.thread_pool, give_up, out,
                      levels ? levels_of(film, engine, *levels, give_up) : LevelsOf());
}

namespace {

/// The same view with one pixel for each step x step pixels, centred on the middle of the first of them.
SceneView with_larger_pixels(SceneView scene, int step) {
  CameraColumns& camera = scene.camera;
  const auto size = static_cast<float>(step);
  camera.corner = camera.corner + 0.5f * (1 - size) * (camera.du + camera.dv);
  camera.du = size * camera.du, camera.dv = size * camera.dv;
  scene.width = (scene.width + step - 1) / step, scene.height = (scene.height + step - 1) / step;
  scene.subpixel_lights = {};  // they were found for the pixels as they are
  return scene;
}

void put_rgba(const CleanPicture& picture, ThreadPool& thread_pool, std::vector<float>& rgba) {
  const auto width = static_cast<std::size_t>(picture.width);
  rgba.resize(4 * width * static_cast<std::size_t>(picture.height));
  thread_pool.for_each(picture.height, [&](int y) {
    const float* from = picture.rgb.data() + 3 * width * static_cast<std::size_t>(y);
    float* to = rgba.data() + 4 * width * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x, from += 3, to += 4)
      to[0] = from[0], to[1] = from[1], to[2] = from[2], to[3] = 1;
  });
}

}  // namespace

bool FilmCleaner::run_coarse(int step, const RenderEngine& engine, double quantum, const std::atomic<bool>& give_up,
                             CleanPicture& out) {
  const SceneView scene = with_larger_pixels(engine.scene, step);
  const RenderEngine coarse{engine.thread_pool, engine.kernels, scene};
  const Region whole{0, 0, scene.width, scene.height};
  Film& film = coarse_film_;
  if (!(film.region == whole) || film.emission.empty() == scene.has_lights())
    film = make_film(scene.width, scene.height, whole, 0, quantum, scene.has_lights());
  film.quantum = quantum;
  change_scene();
  return Pass(whole, 0, min_clean_spp, 1, 0, {.reuses_paths = scene.reuses_paths}).run(coarse, film, give_up) &&
         run(film, coarse, nullptr, give_up, out);
}

CleanPicture clean_film(const Film& film, const PreparedScene& scene, int threads, const std::string& isa) {
  const Kernels kernels = kernels_of(isa);
  ThreadPool thread_pool(threads);
  CleanPicture picture;
  PixelLevels levels;
  const std::atomic<bool> never = false;
  FilmCleaner(kernels).run(film, {thread_pool, kernels, scene.view()}, &levels, never, picture);
  return picture;
}

void LiveClean::set_wanted(bool wanted) {
  if (wanted == wanted_) return;
  wanted_ = wanted;
  start_over();
}

void LiveClean::start_over() {
  latest_ = nullptr;
  made_of_ = 0;
  spent_ = 0;
}

bool LiveClean::is_due(const Progression& picture, bool at_rest) const {
  constexpr double max_fraction = 0.25;
  const std::uint32_t taken = picture.taken(), maximum = picture.max_taken();
  const bool same = taken == made_of_ && maximum == made_of_max_;
  if (!wanted_ || picture.within_pass() || taken < min_clean_spp || same) return false;
  if (made_of_ == 0 || at_rest) return true;
  const double with_this = spent_ + last_seconds_;
  return (taken >= 2 * made_of_ || maximum >= 2 * made_of_max_) &&
         with_this <= max_fraction * (picture.tally().seconds + with_this);
}

/// The filtered picture as a frame.
std::shared_ptr<CleanFrame> LiveClean::take_frame(const PictureGrid& grid, ThreadPool& thread_pool) {
  CleanFrameMemory& memory = grid.spacing > 1 ? coarse_frames_ : frames_;
  std::shared_ptr<CleanFrame> frame = memory.take(picture_.rgb.size() / 3);
  put_rgba(picture_, thread_pool, frame->rgba);
  std::swap(frame->pixel_error, picture_.pixel_error);
  frame->grid = grid;
  return frame;
}

bool LiveClean::make_coarse(const Film& film, double paths_per_second, const RenderEngine& engine,
                            const std::atomic<bool>& give_up) {
  const int step =
      coarse_clean_step(static_cast<std::int64_t>(film.pixels.size()), paths_per_second, seconds_per_pixel_);
  if (!wanted_ || step == 1) return false;
  try {
    if (!coarse_.run_coarse(step, engine, film.quantum, give_up, picture_)) return false;
    const std::shared_ptr<CleanFrame> frame =
        take_frame({picture_.width, picture_.height, static_cast<float>(step)}, engine.thread_pool);
    frame->relative_error = std::numeric_limits<double>::infinity();
    latest_ = frame;
  } catch (const std::bad_alloc&) {
    return false;  // the picture is shown as it is
  }
  return true;
}

bool LiveClean::make(Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const bool whole = cleaner_.run(picture.film(), engine, &picture.levels(), give_up, picture_);
    last_seconds_ = seconds_since(start);
    spent_ += last_seconds_;
    if (!whole) return false;
    seconds_per_pixel_ = last_seconds_ / static_cast<double>(picture.film().pixels.size());
    const std::shared_ptr<CleanFrame> frame = take_frame({picture_.width, picture_.height, 1}, engine.thread_pool);
    frame->relative_error = picture_.relative_error;
    frame->spp = picture.taken();
    frame->doubtful = is_doubtful(picture_, frame->spp);
    frame->seconds = picture.tally().seconds + spent_;
    latest_ = frame;
  } catch (const std::bad_alloc&) {
    latest_ = nullptr;  // the picture is shown as it is
  }
  made_of_ = picture.taken();
  made_of_max_ = picture.max_taken();
  return true;
}

}  // namespace tyndall

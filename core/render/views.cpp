#include "core/render/views.h"

#include <utility>

namespace tyndall {

void Views::change_scene(std::shared_ptr<const PreparedScene> scene) {
  scene_ = std::move(scene);
  first_hits_.clear();
  costs_due_ = true;
}

void Views::find_due_costs(const RenderEngine& engine, const std::atomic<bool>& give_up) {
  if (!costs_due_) return;
  std::vector<float> found = find_costs(engine.kernels, engine.scene, engine.thread_pool, give_up);
  if (found.empty()) return;
  costs_ = std::move(found);
  costs_due_ = false;
}

/// Draws the view of noise or of samples. Until the new picture has enough samples, the old drawing stays.
void Views::draw_counts(View view, const Progression& picture, std::vector<float>& rgba) {
  const Film& film = picture.film();
  const std::uint32_t minimum = view == View::noise ? 2 : 1;  // fewer samples show nothing
  if (picture.taken() >= minimum) {
    counts_ = view == View::noise ? noise_rgba(film) : samples_rgba(film);
    counts_of_ = view;
    white_of_counts_ = view == View::noise ? 1 : twice_mean_samples(film);
  }
  const bool known = counts_of_ == view && counts_.size() == 4 * film.pixels.size();
  white_ = known ? white_of_counts_ : 1;
  rgba = known ? counts_ : grey_rgba(film.pixels.size(), 0.5f);
}

PictureGrid Views::draw(View view, const Progression& picture, const CleanFrame* clean, const RenderEngine& engine,
                        const std::atomic<bool>& give_up, std::vector<float>& rgba) {
  const Film& film = picture.film();
  const std::size_t pixels = film.pixels.size();
  const PictureGrid every_pixel{film.region.width(), film.region.height(), 1};
  white_ = 1;
  switch (view) {
    case View::beauty:
      if (picture.is_filling()) return filled_rgba(film, picture.step(), engine.thread_pool, rgba), every_pixel;
      return coarse_rgba(film, picture.step(), engine.thread_pool, rgba);
    case View::noise:
      if (clean && clean->spp > 0) {
        rgba = noise_rgba(clean->pixel_error);
        return every_pixel;
      }
      [[fallthrough]];
    case View::samples:
      draw_counts(view, picture, rgba);
      return every_pixel;
    case View::cost:
      find_due_costs(engine, give_up);
      rgba = costs_.size() == pixels ? relative_rgba(costs_) : grey_rgba(pixels, 0);
      white_ = static_cast<double>(largest(costs_));
      return every_pixel;
    case View::albedo:
    case View::normal:
    case View::depth:
    case View::object:
      break;
  }
  if (first_hits_.empty()) first_hits_ = find_first_hits(engine.kernels, engine.scene, engine.thread_pool);
  rgba = view == View::object ? object_rgba(first_hits_, scene_->columns()) : first_hit_rgba(first_hits_, view);
  if (view == View::depth) white_ = static_cast<double>(farthest(first_hits_));
  return every_pixel;
}

}  // namespace tyndall

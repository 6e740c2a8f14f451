#include "core/render/views.h"

#include <utility>

namespace tyndall {

void Views::change_scene() {
  first_hits_.clear();
  costs_due_ = true;
}

void Views::find_due_costs(const RenderEngine& engine, const std::atomic<bool>& give_up) {
  if (!costs_due_) return;
  std::vector<float> found = find_costs(engine.kernels, engine.scene, engine.crew, give_up);
  if (found.empty()) return;
  costs_ = std::move(found);
  costs_due_ = false;
}

void Views::draw(View view, const Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up,
                 std::vector<float>& rgba) {
  const Film& film = picture.film();
  const std::size_t pixels = film.pixels.size();
  switch (view) {
    case View::beauty:
      beauty_rgba(film, picture.step(), engine.crew, rgba);
      return;
    case View::noise:
      rgba = picture.taken() == 0 ? grey_rgba(pixels, 1) : noise_rgba(film);
      return;
    case View::samples:
      rgba = picture.taken() == 0 ? grey_rgba(pixels, 0) : samples_rgba(film);
      return;
    case View::cost:
      find_due_costs(engine, give_up);
      rgba = costs_.size() == pixels ? relative_rgba(costs_) : grey_rgba(pixels, 0);
      return;
    case View::albedo:
    case View::normal:
    case View::depth:
      break;
  }
  if (first_hits_.empty()) first_hits_ = find_first_hits(engine.kernels, engine.scene, engine.crew);
  rgba = first_hit_rgba(first_hits_, view);
}

}  // namespace tyndall

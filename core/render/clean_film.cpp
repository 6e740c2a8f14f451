#include "core/render/clean_film.h"

#include "core/base/seconds.h"
#include "core/materials/materials.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace tyndall {
namespace {

/// Whether a ray that meets the surface goes on, if at all, as one that a mirror reflects.
bool is_sharp(const SceneView& scene, std::int32_t element) {
  const std::int32_t material = scene.material[element], kind = scene.kind[material];
  if (kind == place_in<Dielectric<double>, MaterialKinds<double>>) return false;
  return kind != place_in<Metal<double>, MaterialKinds<double>> || scene.parameter[0][material] <= least_sampled_fuzz;
}

}  // namespace

FilmCleaner::FilmCleaner(const Kernels& kernels) : cleaner_(find_target(kernels.isa).value_or(Target::scalar)) {}

bool FilmCleaner::find_first_seen(const Region& region, const RenderEngine& engine, const std::atomic<bool>& give_up) {
  const auto width = static_cast<std::size_t>(region.width());
  std::vector<FirstSeen> seen(width * static_cast<std::size_t>(region.height()));
  engine.crew.for_each(region.height(), [&](int row) {
    if (give_up.load(std::memory_order_relaxed)) return;
    thread_local std::vector<FirstHit> hits;
    hits.resize(width);
    const int y = region.y0 + row;
    engine.kernels.first_hits(engine.scene, {region.x0, y, region.x1, y + 1}, hits.data());
    for (std::size_t x = 0; x < width; ++x) {
      FirstSeen& to = seen[static_cast<std::size_t>(row) * width + x];
      if (hits[x].element >= 0)
        to = {hits[x].albedo, hits[x].normal, hits[x].depth, is_sharp(engine.scene, hits[x].element)};
    }
  });
  if (!read_first_seen(seen, region.width(), region.height(), engine.crew, give_up, input_)) return false;
  seen_of_ = region;
  return true;
}

bool FilmCleaner::run(const Film& film, const RenderEngine& engine, const std::atomic<bool>& give_up,
                      CleanPicture& out) {
  if (seen_of_ != film.region && !find_first_seen(film.region, engine, give_up)) return false;
  return read_film(film, engine.crew, give_up, input_) && cleaner_.run(input_, engine.crew, give_up, out);
}

CleanPicture clean_film(const Film& film, const RenderScene& scene, int threads, const std::string& isa) {
  const auto kernels = choose_kernels(isa);
  if (!kernels) throw std::invalid_argument("no filter for instruction set \"" + isa + "\"");
  Crew crew(threads);
  const SceneViewOf view(scene);
  CleanPicture picture;
  FilmCleaner(*kernels).run(film, {crew, *kernels, view.view()}, false, picture);
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
  constexpr double most_share = 0.25;
  const std::uint32_t taken = picture.taken();
  if (!wanted_ || picture.within_pass() || taken < least_clean_spp || taken == made_of_) return false;
  if (made_of_ == 0 || at_rest) return true;
  const double with_this = spent_ + last_seconds_;
  return taken >= 2 * made_of_ && with_this <= most_share * (picture.tally().seconds + with_this);
}

bool LiveClean::make(const Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const bool whole = cleaner_.run(picture.film(), engine, give_up, picture_);
    last_seconds_ = seconds_since(start);
    spent_ += last_seconds_;
    if (!whole) return false;
    auto frame = std::make_shared<CleanFrame>();
    frame->rgba.resize(4 * picture_.pixel_error.size());
    for (std::size_t i = 0; i < picture_.pixel_error.size(); ++i) {
      std::copy_n(picture_.rgb.data() + 3 * i, 3, frame->rgba.data() + 4 * i);
      frame->rgba[4 * i + 3] = 1;
    }
    frame->pixel_error = picture_.pixel_error;
    frame->relative_error = picture_.relative_error;
    frame->spp = picture.taken();
    frame->seconds = picture.tally().seconds + spent_;
    latest_ = std::move(frame);
  } catch (const std::bad_alloc&) {
    latest_ = nullptr;  // the picture is shown as it is
  }
  made_of_ = picture.taken();
  return true;
}

}  // namespace tyndall

#include "core/render/mailbox.h"

#include "core/base/seconds.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr std::uint32_t default_limit = 4096;  // samples a pixel, where the scene names none

std::uint32_t limit_of(const Scene& scene) {
  return static_cast<std::uint32_t>(scene.render.spp.value_or(static_cast<int>(default_limit)));
}

/// Whether both cameras see the same. A camera without a lens has everything in focus, wherever it is focused.
bool same_view(const Camera& a, Camera b) {
  if (a.defocus_angle == 0 && b.defocus_angle == 0) b.focus_distance = a.focus_distance;
  return a == b;
}

}  // namespace

SceneChange change_between(const Scene& before, const Scene& after) {
  // By name and one by one, because a copy of a large scene costs more than the comparison. A member that is added to
  // Scene does not compile here until it was decided whether samples depend on it.
  const auto& [name_a, width_a, height_a, camera_a, background_a, render_a, display_a, textures_a, materials_a,
               objects_a] = before;
  const auto& [name_b, width_b, height_b, camera_b, background_b, render_b, display_b, textures_b, materials_b,
               objects_b] = after;
  RenderSettings render = render_b;
  render.spp = render_a.spp;
  const bool same = width_a == width_b && height_a == height_b && background_a == background_b && render_a == render &&
                    textures_a == textures_b && materials_a == materials_b && objects_a == objects_b;
  return {!same_view(camera_a, camera_b), !same};
}

void Mailbox::wake(bool give_up) {
  if (give_up) give_up_ = true;
  news_.notify_one();
}

std::uint64_t Mailbox::submit(std::shared_ptr<const Scene> scene, std::shared_ptr<Film> film) {
  const std::lock_guard lock(mutex_);
  orders_.redraw |= limit_ != limit_of(*scene);  // each frame tells whether it is finished
  limit_ = limit_of(*scene);
  const bool same = !film && newest_ && change_between(*newest_, *scene).none();
  newest_ = std::move(scene);
  if (!same) {
    orders_.scene = newest_;
    orders_.film = std::move(film);
    orders_.submitted = Clock::now();
    ++orders_.edit;
  }
  wake(!same);
  return orders_.edit;
}

void Mailbox::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  paused_ = paused;
  wake(false);
}

bool Mailbox::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void Mailbox::restart() {
  const std::lock_guard lock(mutex_);
  orders_.restart = true;
  wake(true);
}

void Mailbox::set_view(View view) {
  const std::lock_guard lock(mutex_);
  if (orders_.view == view) return;
  orders_.view = view;
  orders_.redraw = true;
  wake(true);
}

void Mailbox::set_clean(bool clean) {
  const std::lock_guard lock(mutex_);
  if (orders_.clean == clean) return;
  orders_.clean = clean;
  orders_.redraw = true;
  wake(true);
}

void Mailbox::set_threads(int threads) {
  const std::lock_guard lock(mutex_);
  orders_.threads = threads;
  wake(true);
}

void Mailbox::set_shown_pixels(std::int64_t pixels) {
  const std::lock_guard lock(mutex_);
  orders_.shown_pixels = pixels;  // of use with the next picture
}

void Mailbox::refine_first(const Region& part) {
  const std::lock_guard lock(mutex_);
  orders_.first = part;  // from the next pass on
}

void Mailbox::watch_pixel(std::optional<std::pair<int, int>> pixel) {
  const std::lock_guard lock(mutex_);
  if (orders_.pixel == pixel) return;
  orders_.pixel = pixel;
  other_pixel_ = true;
  wake(false);
}

std::shared_ptr<const PixelReport> Mailbox::pixel() const {
  const std::lock_guard lock(mutex_);
  return pixel_;
}

void Mailbox::note_shown(std::uint64_t pass) {
  const std::lock_guard lock(mutex_);
  if (pass <= shown_pass_) return;
  shown_pass_ = pass;
  shown_at_ = Clock::now();
  wake(false);
}

std::optional<double> Mailbox::wait_until_shown(std::uint64_t pass) {
  constexpr auto patience = std::chrono::milliseconds(50);
  std::unique_lock lock(mutex_);
  if (shown_pass_ == 0) return {};
  news_.wait_for(lock, patience, [&] { return shown_pass_ >= pass || give_up_; });
  if (shown_pass_ < pass) return {};
  return seconds_between(posted_at_, shown_at_);
}

std::future<Film> Mailbox::ask_for_film() {
  const std::lock_guard lock(mutex_);
  auto answer = films_.emplace_back().get_future();
  wake(false);
  return answer;
}

std::shared_ptr<const Frame> Mailbox::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

std::shared_ptr<const RenderProblem> Mailbox::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

std::shared_ptr<const PreparedScene> Mailbox::prepared() const {
  const std::lock_guard lock(mutex_);
  return prepared_;
}

bool Mailbox::wait(const StopToken& stop, const std::function<bool(std::uint32_t limit)>& unfinished) {
  std::unique_lock lock(mutex_);
  const bool news = news_.wait(lock, stop, [&] {
    return orders_.scene || orders_.restart || orders_.redraw || orders_.threads > 0 || other_pixel_ ||
           !films_.empty() || unfinished(limit());
  });
  return news && !stop.stop_requested();
}

Orders Mailbox::take() {
  const std::lock_guard lock(mutex_);
  Orders taken = orders_;
  taken.limit = limit();
  orders_.scene = nullptr;
  orders_.film = nullptr;
  orders_.restart = orders_.redraw = false;
  orders_.threads = 0;
  other_pixel_ = false;
  give_up_ = false;
  return taken;
}

std::vector<std::promise<Film>> Mailbox::take_film_requests() {
  const std::lock_guard lock(mutex_);
  return std::exchange(films_, {});
}

void Mailbox::post(std::shared_ptr<Frame> frame) {
  const std::lock_guard lock(mutex_);
  frame->finished = frame->spp >= limit_ && !frame->awaits_clean;
  latest_ = std::move(frame);
  posted_at_ = Clock::now();
}

void Mailbox::post(RenderProblem problem) {
  const std::lock_guard lock(mutex_);
  problem_ = std::make_shared<const RenderProblem>(std::move(problem));
}

void Mailbox::post(PixelReport report) {
  const std::lock_guard lock(mutex_);
  pixel_ = std::make_shared<const PixelReport>(report);
}

void Mailbox::post(std::shared_ptr<const PreparedScene> scene) {
  const std::lock_guard lock(mutex_);
  prepared_ = std::move(scene);
  problem_ = nullptr;
}

}  // namespace tyndall

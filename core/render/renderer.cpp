#include "core/render/renderer.h"

#include "core/render/director.h"

#include <stdexcept>
#include <utility>

namespace tyndall {
namespace {

constexpr std::uint32_t default_limit = 4096;  // samples a pixel, where the scene names none

/// Whether two scenes give the same picture: what is not rendered is left out.
bool same_picture(const Scene& a, Scene b) {
  b.name = a.name;
  b.display = a.display;
  b.render.spp = a.render.spp;
  return a == b;
}

Kernels kernels_or_throw(const std::string& isa) {
  const auto kernels = choose_kernels(isa);
  if (!kernels) throw std::invalid_argument("no kernel for instruction set \"" + isa + "\"");
  return *kernels;
}

}  // namespace

struct Renderer::State {
  Mailbox mail;
  Director director;
  std::jthread thread;  // last: stopped and joined first

  State(const Options& options, std::function<void()> on_frame)
      : director(mail, kernels_or_throw(options.isa), options.threads, std::move(on_frame)),
        thread([this](const std::stop_token& stop) { director.run(stop); }) {}
};

Renderer::Renderer(Options options, std::function<void()> on_frame)
    : state_(std::make_unique<State>(options, std::move(on_frame))) {}

Renderer::~Renderer() {
  state_->thread.request_stop();
  state_->thread.join();
  for (auto& film : state_->mail.films) film.set_value({});
}

std::uint64_t Renderer::submit(Scene scene) {
  Mailbox& mail = state_->mail;
  const std::lock_guard lock(mail.mutex);
  const auto limit = static_cast<std::uint32_t>(scene.render.spp.value_or(static_cast<int>(default_limit)));
  mail.frame_outdated |= mail.limit != limit;  // finished or not is told by the frame
  mail.limit = limit;
  const bool same = mail.edit > 0 && same_picture(mail.newest, scene);
  mail.newest = scene;
  if (!same) {
    mail.scene = std::make_unique<Scene>(std::move(scene));
    mail.submitted = Clock::now();
    ++mail.edit;
    mail.give_up = true;
  }
  mail.wake.notify_one();
  return mail.edit;
}

std::shared_ptr<const Frame> Renderer::latest() const {
  const std::lock_guard lock(state_->mail.mutex);
  return state_->mail.latest;
}

std::shared_ptr<const RenderProblem> Renderer::problem() const {
  const std::lock_guard lock(state_->mail.mutex);
  return state_->mail.problem;
}

void Renderer::pause(bool paused) {
  const std::lock_guard lock(state_->mail.mutex);
  state_->mail.paused = paused;  // after the pass that is under way
  state_->mail.wake.notify_one();
}

bool Renderer::paused() const {
  const std::lock_guard lock(state_->mail.mutex);
  return state_->mail.paused;
}

void Renderer::restart() {
  const std::lock_guard lock(state_->mail.mutex);
  state_->mail.restart = true;
  state_->mail.give_up = true;
  state_->mail.wake.notify_one();
}

void Renderer::set_view(View view) {
  const std::lock_guard lock(state_->mail.mutex);
  if (state_->mail.view == view) return;
  state_->mail.view = view;
  state_->mail.frame_outdated = true;
  state_->mail.give_up = true;
  state_->mail.wake.notify_one();
}

void Renderer::set_threads(int threads) {
  const std::lock_guard lock(state_->mail.mutex);
  state_->mail.threads = threads;
  state_->mail.give_up = true;
  state_->mail.wake.notify_one();
}

Film Renderer::film() const {
  std::future<Film> answer;
  {
    const std::lock_guard lock(state_->mail.mutex);
    answer = state_->mail.films.emplace_back().get_future();
    state_->mail.wake.notify_one();
  }
  return answer.get();
}

Renderer::Pick Renderer::pick(int x, int y) const {
  std::shared_ptr<const RenderScene> scene;
  {
    const std::lock_guard lock(state_->mail.mutex);
    scene = state_->mail.compiled;
  }
  if (!scene || x < 0 || y < 0 || x >= scene->width || y >= scene->height) return {};
  const SceneViewOf view(*scene);
  FirstHit hit;
  scalar_kernels().first_hits(view.view(), {x, y, x + 1, y + 1}, &hit);
  if (hit.element < 0) return {};
  const auto column = static_cast<double>(x) + 0.5, row = static_cast<double>(y) + 0.5;
  const CameraColumns& c = scene->camera;
  const auto widen = [](Vec3f v) { return Vec3d{v.x, v.y, v.z}; };
  const Vec3d way = widen(c.corner) + column * widen(c.du) + row * widen(c.dv);
  const double scale = static_cast<double>(hit.depth) / dot(way, widen(c.axis));
  return {scene->elements.object[static_cast<std::size_t>(hit.element)], static_cast<double>(hit.depth),
          scene->origin + widen(c.center) + scale * way};
}

}  // namespace tyndall

#include "core/render/renderer.h"

#include "core/render/render_loop.h"

#include <utility>

namespace tyndall {

struct Renderer::State {
  Mailbox mail;
  RenderLoop loop;
  StoppableThread thread;  // declared last, so that it ends before the members that it uses

  State(const Options& options, std::function<void()> on_frame)
      : loop(mail, kernels_of(options.isa), options.threads, std::move(on_frame)),
        thread([this](const StopToken& stop) { loop.run(stop); }) {}
};

Renderer::Renderer(const Options& options, std::function<void()> on_frame)
    : state_(std::make_unique<State>(options, std::move(on_frame))) {}

Renderer::~Renderer() {
  state_->thread.request_stop();
  state_->mail.interrupt();
  state_->thread.join();
  for (auto& request : state_->mail.take_film_requests()) request.set_value({});  // so that no caller waits forever
}

std::uint64_t Renderer::request(RenderRequest request) { return state_->mail.request(std::move(request)); }

RenderReply Renderer::reply() const { return state_->mail.reply(); }

void Renderer::note_shown(std::uint64_t pass) { state_->mail.note_shown(pass); }

Film Renderer::film() const { return state_->mail.ask_for_film().get(); }

Renderer::Pick Renderer::pick(int x, int y) const {
  const std::shared_ptr<const PreparedScene> prepared = state_->mail.prepared();
  if (!prepared) return {};
  const RenderScene* scene = &prepared->columns();
  if (x < 0 || y < 0 || x >= scene->width || y >= scene->height) return {};
  FirstHit hit;
  scalar_kernels().first_hits(prepared->view(), {x, y, x + 1, y + 1}, &hit);
  if (hit.element < 0) return {};
  const auto column = static_cast<double>(x) + 0.5, row = static_cast<double>(y) + 0.5;
  const CameraColumns& c = scene->camera;
  const Vec3d offset = to_double(c.corner) + column * to_double(c.du) + row * to_double(c.dv);
  const double scale = static_cast<double>(hit.depth) / dot(offset, to_double(c.axis));
  return {scene->object_of(hit.element), static_cast<double>(hit.depth),
          scene->origin + to_double(c.center) + scale * offset};
}

}  // namespace tyndall

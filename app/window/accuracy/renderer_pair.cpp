#include "app/window/accuracy/renderer_pair.h"

#include <utility>

namespace tyndall {

RendererPair::RendererPair(int threads, std::string isa, std::function<void()> on_frame)
    : isa_(std::move(isa)),
      on_frame_([this, on_frame = std::move(on_frame)] {
        share_.on_frame();
        on_frame();
      }),
      threads_(threads),
      renderer_({threads, isa_}, on_frame_) {
  share_.set_threads(threads);
}

RendererPair::~RendererPair() {
  share_.share_with(nullptr);  // before the second renderer is destroyed
}

RendererPair::Begun RendererPair::submit(const std::shared_ptr<const Scene>& scene, std::shared_ptr<Film> film) {
  Begun begun;
  const std::uint64_t before = edit_;
  edit_ = renderer_.submit(scene, std::move(film));
  begun.current = edit_ != before;
  begun.kept = second_ && submit_kept(*scene);
  return begun;
}

void RendererPair::restart() {
  if (const auto frame = renderer_.latest()) restarted_after_ = frame->pass;
  renderer_.restart();
  if (second_) second_->restart();
}

void RendererPair::begin_split(const Scene& scene) {
  kept_ = scene.render;
  second_ = std::make_shared<Renderer>(Renderer::Options{threads_, isa_}, on_frame_);
  second_->set_view(view_);
  second_->set_clean(clean_);
  second_->set_shown_pixels(shown_pixels_);
  second_->refine_first(first_);
  kept_edit_ = 0;
  submit_kept(scene);
  renderer_.restart();
  share_.share_with(second_.get());
}

std::shared_ptr<Renderer> RendererPair::end_split() {
  share_.share_with(nullptr);
  return std::exchange(second_, nullptr);
}

Scene RendererPair::kept_scene(const Scene& scene) const {
  Scene kept = scene;
  kept.render = kept_;
  kept.render.spp = scene.render.spp;
  return kept;
}

bool RendererPair::submit_kept(const Scene& scene) {
  const std::uint64_t before = kept_edit_;
  kept_edit_ = second_->submit(kept_scene(scene));
  return kept_edit_ != before;
}

void RendererPair::pause(bool paused) {
  paused_ = paused;
  share_.pause(paused);
}

void RendererPair::set_threads(int threads) {
  threads_ = threads;
  share_.set_threads(threads);
}

void RendererPair::set_shown_pixels(std::int64_t pixels) {
  if (pixels == shown_pixels_) return;
  shown_pixels_ = pixels;
  renderer_.set_shown_pixels(pixels);
  if (second_) second_->set_shown_pixels(pixels);
}

void RendererPair::refine_first(const Region& part) {
  first_ = part;
  renderer_.refine_first(part);
  if (second_) second_->refine_first(part);
}

void RendererPair::note_shown(Half half, std::uint64_t pass) {
  if (half == Half::current)
    renderer_.note_shown(pass);
  else if (second_)
    second_->note_shown(pass);
}

void RendererPair::set_view(View view) {
  view_ = view;
  renderer_.set_view(view);
  if (second_) second_->set_view(view);
}

void RendererPair::set_clean(bool clean) {
  clean_ = clean;
  renderer_.set_clean(clean);
  if (second_) second_->set_clean(clean);
}

std::shared_ptr<const Frame> RendererPair::latest(Half half) const {
  if (half == Half::current) return renderer_.latest();
  return second_ ? second_->latest() : nullptr;
}

bool RendererPair::finished() const {
  const auto ended = [this](Half half) {
    const auto frame = latest(half);
    return frame && frame->edit == edit(half) && frame->finished && frame->view == view_ &&
           (!clean_ || frame->clean || frame->spp < least_clean_spp);
  };
  const bool current = ended(Half::current) && renderer_.latest()->pass > restarted_after_;
  return current && (!second_ || ended(Half::kept));
}

bool RendererPair::resting() const {
  const auto finished = [this](Half half) {
    const auto frame = latest(half);
    return !frame || frame->finished;
  };
  return paused_ || (finished(Half::current) && finished(Half::kept));
}

}  // namespace tyndall

#include "app/window/rendering/renderer_pair.h"

#include "core/render/clean_film.h"

#include <utility>

namespace tyndall {

RendererPair::RendererPair(int threads, std::string isa, std::function<void()> on_frame)
    : isa_(std::move(isa)),
      on_frame_([this, on_frame = std::move(on_frame)] {
        budget_.on_frame();
        on_frame();
      }),
      renderer_({threads, isa_}, on_frame_) {}

RendererPair::~RendererPair() {
  budget_.split_with(nullptr);  // before the second renderer is destroyed
}

RendererPair::Begun RendererPair::request(const RenderRequest& current, const RenderRequest& kept) {
  if (current == current_ && kept == kept_) return {};
  const auto frame = renderer_.latest();
  if (current.restarts != current_.restarts && frame) restarted_after_ = frame->pass;
  current_ = current;
  kept_ = kept;
  Begun begun;
  if (kept.scene && !second_) {
    second_ = std::make_shared<Renderer>(Renderer::Options{current.threads, isa_}, on_frame_);
    kept_edit_ = 0;
    budget_.split_with(second_.get());
  } else if (!kept.scene && second_) {
    budget_.split_with(nullptr);
    begun.ended = std::exchange(second_, nullptr);
  }
  const ThreadBudget::Edits edits = budget_.request(current, kept);
  begun.current = edits.first != edit_.exchange(edits.first);
  begun.kept = second_ && edits.second != std::exchange(kept_edit_, edits.second);
  return begun;
}

void RendererPair::note_shown(Half half, std::uint64_t pass) {
  if (half == Half::current)
    renderer_.note_shown(pass);
  else if (second_)
    second_->note_shown(pass);
}

std::shared_ptr<const Frame> RendererPair::latest(Half half) const {
  if (half == Half::current) return renderer_.latest();
  return second_ ? second_->latest() : nullptr;
}

bool RendererPair::finished() const {
  const auto ended = [this](Half half) {
    const auto frame = latest(half);
    return frame && frame->edit == edit(half) && frame->finished && frame->view == current_.view &&
           (!current_.clean || frame->clean || frame->spp < min_clean_spp);
  };
  const bool current = ended(Half::current) && renderer_.latest()->pass > restarted_after_;
  return current && (!second_ || ended(Half::kept));
}

bool RendererPair::resting() const {
  const auto finished = [this](Half half) {
    const auto frame = latest(half);
    return !frame || frame->finished;
  };
  return current_.paused || (finished(Half::current) && finished(Half::kept));
}

}  // namespace tyndall

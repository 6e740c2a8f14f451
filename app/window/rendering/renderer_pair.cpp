#include "app/window/rendering/renderer_pair.h"

#include "core/render/clean_film.h"

#include <utility>

namespace tyndall {
namespace {

constexpr double slice = 0.3, slack = 0.5;  // seconds of a turn; by which one may be ahead while both work

RenderingTime time_of(const Renderer& renderer) {
  const auto frame = renderer.latest();
  return frame ? RenderingTime{frame->seconds, frame->finished} : RenderingTime{};
}

}  // namespace

Active next_active(Active now, RenderingTime first, RenderingTime second, bool together) {
  if (first.finished || second.finished) return Active::both;  // one that has finished takes no time from the other
  const double lead = first.seconds - second.seconds;
  if (together) {
    if (now == Active::second && lead > 0) return Active::second;
    if (now == Active::first && lead < 0) return Active::first;
    return lead > slack ? Active::second : lead < -slack ? Active::first : Active::both;
  }
  if (now == Active::both) return lead > 0 ? Active::second : Active::first;
  if (now == Active::first) return lead > slice ? Active::second : Active::first;
  return lead < -slice ? Active::first : Active::second;
}

void ThreadBudget::begin(int threads, bool split) {
  threads_ = threads, split_ = split;
  active_ = split && !together() ? Active::first : Active::both;
}

bool ThreadBudget::go_on(RenderingTime current, RenderingTime kept) {
  const Active active = split_ ? next_active(active_, current, kept, together()) : Active::both;
  return std::exchange(active_, active) != active;
}

RenderRequest ThreadBudget::part_of(RenderRequest wanted, Half half) const {
  if (split_ && together()) wanted.threads /= 2;
  wanted.paused |= active_ == (half == Half::current ? Active::second : Active::first);
  return wanted;
}

RendererPair::RendererPair(int threads, std::string isa, std::function<void()> on_frame)
    : isa_(std::move(isa)), told_(std::move(on_frame)), renderer_({threads, isa_}, [this] { on_frame_of_either(); }) {}

RendererPair::~RendererPair() {
  const Begun last = request(current_);  // the second renderer goes first, and the other one knows of it
}

RendererPair::Begun RendererPair::request(const RenderRequest& current, const RenderRequest& kept) {
  if (current == current_ && kept == kept_) return {};
  const std::lock_guard lock(mutex_);
  const auto frame = renderer_.latest();
  if (current.restarts != current_.restarts && frame) restarted_after_ = frame->pass;
  const bool split = kept.scene != nullptr;
  if (current.threads != current_.threads || split != (second_ != nullptr)) budget_.begin(current.threads, split);
  current_ = current;
  kept_ = kept;
  Begun begun;
  if (!split) begun.ended = std::exchange(second_, nullptr);
  if (split && !second_) {
    const int threads = budget_.part_of(kept, Half::kept).threads;
    second_ = std::make_shared<Renderer>(Renderer::Options{threads, isa_}, [this] { on_frame_of_either(); });
    kept_edit_ = 0;
  }
  const std::uint64_t edit = renderer_.request(budget_.part_of(current_, Half::current));
  const std::uint64_t kept_edit = second_ ? second_->request(budget_.part_of(kept_, Half::kept)) : 0;
  begun.current = edit_.exchange(edit) != edit;
  begun.kept = std::exchange(kept_edit_, kept_edit) != kept_edit && second_;
  return begun;
}

void RendererPair::on_frame_of_either() {
  {
    const std::lock_guard lock(mutex_);
    if (second_ && budget_.go_on(time_of(renderer_), time_of(*second_))) {
      renderer_.request(budget_.part_of(current_, Half::current));
      second_->request(budget_.part_of(kept_, Half::kept));
    }
  }
  told_();
}

void RendererPair::note_shown(Half half, std::uint64_t pass) {
  if (half == Half::current)
    renderer_.note_shown(pass);
  else if (second_)
    second_->note_shown(pass);
}

std::shared_ptr<const Frame> RendererPair::latest(Half half) const {
  if (half == Half::current) return renderer_.latest();
  const std::lock_guard lock(mutex_);
  return second_ ? second_->latest() : nullptr;
}

bool RendererPair::finished() const {
  const auto ended = [this](Half half) {
    const auto frame = latest(half);
    return frame && frame->edit == edit(half) && frame->finished && frame->view == current_.view &&
           (!current_.clean || frame->clean || frame->spp < min_clean_spp);
  };
  return ended(Half::current) && renderer_.latest()->pass > restarted_after_ && (!second_ || ended(Half::kept));
}

bool RendererPair::resting() const {
  const auto finished = [this](Half half) {
    const auto frame = latest(half);
    return !frame || frame->finished;
  };
  return current_.paused || (finished(Half::current) && finished(Half::kept));
}

}  // namespace tyndall

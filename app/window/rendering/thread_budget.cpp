#include "app/window/rendering/thread_budget.h"

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

void ThreadBudget::split_with(Renderer* second) {
  const std::lock_guard lock(mutex_);
  second_ = second;
  active_ = first_turn();
}

ThreadBudget::Edits ThreadBudget::request(RenderRequest first, RenderRequest second) {
  const std::lock_guard lock(mutex_);
  const bool other_threads = first.threads != first_wanted_.threads;
  first_wanted_ = std::move(first);
  second_wanted_ = std::move(second);
  if (other_threads) active_ = first_turn();
  return ask();
}

void ThreadBudget::on_frame() {
  const std::lock_guard lock(mutex_);
  if (!second_) return;
  const Active active = next_active(active_, time_of(first_), time_of(*second_), together());
  if (std::exchange(active_, active) != active) ask();
}

/// waits: it is the other one's turn.
RenderRequest ThreadBudget::part_of(const RenderRequest& wanted, bool waits) const {
  RenderRequest part = wanted;
  if (second_ && together()) part.threads /= 2;
  part.paused |= waits;
  return part;
}

ThreadBudget::Edits ThreadBudget::ask() {
  Edits edits;
  edits.first = first_.request(part_of(first_wanted_, active_ == Active::second));
  if (second_) edits.second = second_->request(part_of(second_wanted_, active_ == Active::first));
  return edits;
}

}  // namespace tyndall

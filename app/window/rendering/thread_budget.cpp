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

Turn next_turn(Turn now, RenderingTime first, RenderingTime second, bool together) {
  if (first.finished || second.finished) return Turn::both;  // one that has finished takes no time from the other
  const double lead = first.seconds - second.seconds;
  if (together) {
    if (now == Turn::second && lead > 0) return Turn::second;
    if (now == Turn::first && lead < 0) return Turn::first;
    return lead > slack ? Turn::second : lead < -slack ? Turn::first : Turn::both;
  }
  if (now == Turn::both) return lead > 0 ? Turn::second : Turn::first;
  if (now == Turn::first) return lead > slice ? Turn::second : Turn::first;
  return lead < -slice ? Turn::first : Turn::second;
}

void ThreadBudget::share_with(Renderer* second) {
  const std::lock_guard lock(mutex_);
  second_ = second;
  turn_ = first_turn();
}

ThreadBudget::Edits ThreadBudget::request(RenderRequest first, RenderRequest second) {
  const std::lock_guard lock(mutex_);
  const bool other_threads = first.threads != first_wanted_.threads;
  first_wanted_ = std::move(first);
  second_wanted_ = std::move(second);
  if (other_threads) turn_ = first_turn();
  return ask();
}

void ThreadBudget::on_frame() {
  const std::lock_guard lock(mutex_);
  if (!second_) return;
  const Turn turn = next_turn(turn_, time_of(first_), time_of(*second_), together());
  if (std::exchange(turn_, turn) != turn) ask();
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
  edits.first = first_.request(part_of(first_wanted_, turn_ == Turn::second));
  if (second_) edits.second = second_->request(part_of(second_wanted_, turn_ == Turn::first));
  return edits;
}

}  // namespace tyndall

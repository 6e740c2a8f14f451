#include "app/window/accuracy/fair_share.h"

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

void FairShare::share_with(Renderer* second) {
  const std::lock_guard lock(mutex_);
  second_ = second;
  set_up();
}

void FairShare::set_threads(int threads) {
  const std::lock_guard lock(mutex_);
  threads_ = threads;
  set_up();
}

void FairShare::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  paused_ = paused;
  apply();
}

void FairShare::on_frame() {
  const std::lock_guard lock(mutex_);
  if (!second_) return;
  const Turn turn = next_turn(turn_, time_of(first_), time_of(*second_), together());
  if (turn == turn_) return;
  turn_ = turn;
  apply();
}

void FairShare::set_up() {
  const int each = second_ && together() ? threads_ / 2 : threads_;
  first_.set_threads(each);
  if (second_) second_->set_threads(each);
  turn_ = second_ && !together() ? Turn::first : Turn::both;
  apply();
}

void FairShare::apply() {
  first_.pause(paused_ || turn_ == Turn::second);
  if (second_) second_->pause(paused_ || turn_ == Turn::first);
}

}  // namespace tyndall

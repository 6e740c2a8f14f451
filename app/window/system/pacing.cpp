#include "app/window/system/pacing.h"

#include <algorithm>

namespace tyndall {

double picture_interval(double age, int shown) { return shown < 3 ? 0.0 : std::clamp(0.1 * age, 0.1, 0.5); }

void Pacing::on_edit(unsigned long long edit, double now) {
  if (edit == edit_) return;
  edit_ = edit;
  on_new_start(now);
}

void Pacing::on_new_start(double now) {
  edit_time_ = now;
  shown_ = 0;
  due_ = now;
}

void Pacing::on_picture(unsigned long long edit, double now) {
  if (edit == edit_) ++shown_;
  due_ = now + picture_interval(now - edit_time_, shown_);
}

void Pacing::on_drawn(double now) {
  drawn_ = now;
  if (frames_ > 0) --frames_;
}

void Pacing::wake_at(double time) { wake_ = std::min(wake_, time); }

double Pacing::wait(double now) const {
  const double earliest = drawn_ + min_frame_interval;
  const double next = frames_ == event_frames ? now : frames_ > 0 ? std::min(wake_, drawn_ + echo_interval) : wake_;
  if (next > 1e299) return std::numeric_limits<double>::infinity();
  return std::max({next - now, earliest - now, 0.0});
}

}  // namespace tyndall

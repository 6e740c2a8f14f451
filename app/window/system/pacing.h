#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <utility>

/// Time in the window: its clocks, and when to draw and to send.
namespace tyndall {

/// Seconds that tests let pass without waiting for them.
inline std::atomic<double> skipped_seconds = 0;

/// Seconds of a clock that never goes back.
inline double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count() + skipped_seconds;
}

/// Least time between two drawings.
inline constexpr double min_frame_interval = 0.016;

/// Time between the drawings after an event: they show what appears one drawing later and must not keep pictures
/// waiting where drawing is slow.
inline constexpr double echo_interval = 0.04;

/// How long a new picture of an edit waits after the one before it: the first three of an edit not at all, then 0.1 s,
/// growing with the age of the edit to 0.5 s. age: seconds since the edit; shown: pictures of it shown so far.
inline double picture_interval(double age, int shown) { return shown < 3 ? 0.0 : std::clamp(0.1 * age, 0.1, 0.5); }

/// Decides when the window is drawn: after an event at once and twice more a little later, for a picture when it is
/// due, else never.
class Pacing {
 public:
  /// Something was pressed, moved, resized: draw, and draw further frames for what appears one frame later.
  void on_event() { frames_ = event_frames; }
  /// A picture of `edit` was shown.
  void on_picture(unsigned long long edit, double now) {
    if (edit == edit_) ++shown_;
    due_ = now + picture_interval(now - edit_time_, shown_);
  }
  /// An edit was made: its pictures are due at once.
  void on_edit(unsigned long long edit, double now) {
    if (std::exchange(edit_, edit) != edit) on_new_start(now);
  }
  /// Other pictures of the same edit are due at once: another view, a new start.
  void on_new_start(double now) { edit_time_ = due_ = now, shown_ = 0; }
  /// The window is about to be drawn: forgets wake_at.
  void on_drawing() { wake_ = 1e300; }
  /// The window was drawn.
  void on_drawn(double now) {
    drawn_ = now;
    if (frames_ > 0) --frames_;
  }
  /// The window should be drawn again at that time at the latest (a message goes, a key is held). Asked for anew in
  /// each drawing.
  void wake_at(double time) { wake_ = std::min(wake_, time); }

  /// When a newer picture may be shown; a finished one always may.
  double picture_due() const { return due_; }
  /// The earliest time at which it may be drawn again.
  double next_drawing() const { return drawn_ + min_frame_interval; }
  /// Seconds to wait for events before drawing: 0 draw now; infinite: until something happens.
  double wait(double now) const {
    const double next = frames_ == event_frames ? now : frames_ > 0 ? std::min(wake_, drawn_ + echo_interval) : wake_;
    if (next > 1e299) return std::numeric_limits<double>::infinity();
    return std::max({next - now, next_drawing() - now, 0.0});
  }

 private:
  static constexpr int event_frames = 3;

  int frames_ = event_frames, shown_ = 0;
  unsigned long long edit_ = 0;
  double edit_time_ = 0, due_ = 0, drawn_ = -1, wake_ = 1e300;
};

/// Decides when an edited scene goes to the renderer: as soon as a picture of the scene sent before it was on the
/// screen. A newer scene makes the renderer give up the one that it is at. If scenes were sent as fast as the mouse
/// moves, none would ever be shown. Times are seconds of one clock.
class SendTimer {
 public:
  /// The scene was edited, so its picture differs from that of the scene sent last.
  void on_change(double now) {
    if (changed_at_ < 0) changed_at_ = now;
  }
  /// The newest scene was sent.
  void on_send(double now) { changed_at_ = -1, sent_at_ = now; }

  /// Whether there is something to send.
  bool waits() const { return changed_at_ >= 0; }
  /// When the first edit came that was not sent; < 0: there is none.
  double changed_at() const { return changed_at_; }
  /// Whether to send now. seen: a picture of the scene that was sent last is on the screen.
  bool due(bool seen, double now) const { return waits() && (seen || now >= latest()); }
  /// When it is sent at the latest, picture or not; infinite: nothing waits.
  double latest() const { return waits() ? sent_at_ + patience : std::numeric_limits<double>::infinity(); }

 private:
  static constexpr double patience = 0.4;  // seconds; the picture must not lag behind the mouse by more

  double changed_at_ = -1, sent_at_ = 0;
};

}  // namespace tyndall

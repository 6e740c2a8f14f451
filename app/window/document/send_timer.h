#pragma once
#include <limits>

/// How often edits reach the renderer while something is dragged.
namespace tyndall {

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

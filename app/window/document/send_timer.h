#pragma once
#include <limits>

namespace tyndall {

/// Decides when an edited scene goes to the renderer: once the picture of the one before was seen. So, while something
/// is dragged, each scene that is begun is shown, instead of all being given up for the next. Times are seconds of one
/// clock.
class SendTimer {
 public:
  /// The picture differs from what was sent.
  void on_change(double now) {
    if (changed_at_ < 0) changed_at_ = now;
  }
  /// The newest scene was sent.
  void on_send(double now) { changed_at_ = -1, sent_at_ = now; }

  /// Whether there is something to send.
  bool waits() const { return changed_at_ >= 0; }
  /// Since when; < 0: nothing waits.
  double changed_at() const { return changed_at_; }
  /// seen: a picture of the scene that was sent last has come.
  bool due(bool seen, double now) const { return waits() && (seen || now >= latest()); }
  /// When it is sent at the latest, picture or not; infinite: nothing waits.
  double latest() const { return waits() ? sent_at_ + patience : std::numeric_limits<double>::infinity(); }

 private:
  static constexpr double patience = 0.4;  // seconds; after more, what is shown is too far behind the hand

  double changed_at_ = -1, sent_at_ = 0;
};

}  // namespace tyndall

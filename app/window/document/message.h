#pragma once
#include "app/window/system/pacing.h"
#include "app/window/system/ui_log.h"
#include "core/base/text.h"

#include <limits>
#include <string>
#include <utility>

/// The line in which the window tells the user what happened.
namespace tyndall {

/// What the user is told, one line.
struct Message {
  std::string text;  ///< "": none
  bool error = false;
  double until = 0;  ///< clock second at which it goes; errors stay until something is done about them
};

/// The newest message.
class MessageLine {
 public:
  /// log: may be null.
  explicit MessageLine(UiLog* log) : log_(log) {}

  void say(const std::string& text, bool error = false) { show({text, error, clock_seconds() + 6}); }
  /// Something goes on: the text stays until another one takes its place.
  void say_until_done(const std::string& text) { show({text, false, std::numeric_limits<double>::infinity()}); }
  void dismiss() {
    if (log_ && !current_.text.empty()) log_->line("message");
    current_ = {};
  }
  const Message& current() const { return current_; }
  /// How many errors were said so far.
  int errors() const { return errors_; }

 private:
  void show(Message message) {
    current_ = std::move(message);
    current_.text = printable(current_.text, longest);
    errors_ += current_.error;
    if (log_) log_->line("message " + current_.text);
  }

  static constexpr std::size_t longest = 2000;  // bytes

  UiLog* log_;
  Message current_;
  int errors_ = 0;
};

}  // namespace tyndall

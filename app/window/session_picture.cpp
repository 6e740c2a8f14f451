#include "app/window/session.h"

#include <fmt/core.h>

#include <utility>

/// A picture that another program writes, in place of a scene: what a session does as its rows come.
namespace tyndall {

/// Takes what has come since the last time. Whether anything has.
bool Session::collect_rows() {
  if (!picture_) return false;
  const Arrival before = std::exchange(arrival_, picture_->arrival());
  if (arrival_ == before) return false;
  if (shows_picture()) ++wanted_.restarts;
  if (arrival_.said != before.said) messages_.say(arrival_.said, true);
  return true;
}

std::string Session::arrived() const {
  if (!shows_picture()) return "";
  if (arrival_.rows == picture_->height()) return fmt::format("all {} rows", arrival_.rows);
  return fmt::format("{} {} of {}", arrival_.ended ? "ended at row" : "row", arrival_.rows, picture_->height());
}

}  // namespace tyndall
